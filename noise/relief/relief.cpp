#include "noise/relief/relief.h"

#include <algorithm>
#include <stdexcept>

#define STRATA_RELIEF_FORMULAS
#include <hwy/highway.h>

#include "noise/reference.h"
#include "noise/relief/frame.h"
#include "noise/relief/nodes/all.h"

namespace strata::noise {

namespace {

// Values with their gradients by the coordinates of the point where the relief is asked for.
class JetNumbers : public ReliefFrame {
  public:
    using Number = ReliefJet;
    using Displacement = std::array<Number, 3>;
    struct Domain {
        glm::dvec3 at;
        glm::dmat3 jacobian{1.0};  // of `at`, by columns
    };

    JetNumbers(std::span<const ReliefPart> parts, std::size_t index, int dimensions)
        : ReliefFrame(parts[index], dimensions), parts_(parts) {}

    static Number constant(double x) { return {x, glm::dvec3(0.0)}; }
    static Number plus(const Number& a, const Number& b) { return {a.value + b.value, a.gradient + b.gradient}; }
    static Number scaled(const Number& a, double by) { return {by * a.value, by * a.gradient}; }
    static Number product(const Number& a, const Number& b) {
        return {a.value * b.value, a.value * b.gradient + b.value * a.gradient};
    }
    template <class Curve>
    static Number curved(const Curve& curve, const Number& a) {
        return {curve.value(a.value), curve.slope(a.value) * a.gradient};
    }

    Number octave(std::size_t k, const Domain& at) const {
        const Octave& octave = part().octaves[k];
        if (is_planar()) {
            const auto p = octave_position<2>(octave, {at.at.x, at.at.z});
            const auto jet = reference_jet<2>(octave.key, split_position<2>(p));
            const glm::dvec3 there{jet.gradient[0], 0.0, jet.gradient[1]};
            return {jet.value, octave.frequency * (there * at.jacobian)};
        }
        const auto p = octave_position<3>(octave, {at.at.x, at.at.y, at.at.z});
        const auto jet = reference_jet<3>(octave.key, split_position<3>(p));
        const glm::dvec3 there{jet.gradient[0], jet.gradient[1], jet.gradient[2]};
        return {jet.value, octave.frequency * (there * at.jacobian)};
    }

    static Number begin_sum() { return {}; }
    static bool sees(Number&, std::size_t, const Domain&, double, double) { return true; }
    static void add(Number& sum, const Number& term) { sum = plus(sum, term); }
    static Number total(const Number& sum) { return sum; }

    static Displacement no_displacement() { return {}; }
    Domain displaced(const Domain& at, const Displacement& u) const {
        Domain there = at;
        for (int i = 0; i < static_cast<int>(dimensions()); ++i) {
            const int axis = is_planar() ? 2 * i : i;
            const Number& by = u[static_cast<std::size_t>(i)];
            there.at[axis] += by.value;
            for (int column = 0; column < 3; ++column) there.jacobian[column][axis] += by.gradient[column];
        }
        return there;
    }

    Number input(std::size_t i, const Domain& at) const { return of(parts_, part().inputs[i], dimensions_of(), at); }

    static Number of(std::span<const ReliefPart> parts, std::size_t index, int dimensions, const Domain& at) {
        JetNumbers numbers(parts, index, dimensions);
        return std::visit([&](const auto& node) { return HWY_NAMESPACE::relief_of(node, numbers, at); },
                          parts[index].node);
    }

  private:
    int dimensions_of() const { return static_cast<int>(dimensions()); }

    std::span<const ReliefPart> parts_;
};

std::size_t place_of(std::span<const ReliefTerm> before, const std::string& name) {
    const auto found = std::ranges::find(before, name, &ReliefTerm::name);
    if (found == before.end()) throw std::invalid_argument("relief: no term before has the name '" + name + "'");
    return static_cast<std::size_t>(found - before.begin());
}

ReliefPart make_part(std::span<const ReliefTerm> terms, std::size_t index, int dimensions) {
    const ReliefTerm& term = terms[index];
    ReliefPart part;
    part.node = term.node;
    for (const std::string& name : term.of) part.inputs.push_back(place_of(terms.first(index), name));
    std::visit(
        [&](const auto& node) {
            const auto count = static_cast<int>(part.inputs.size());
            if (count < node.kFewestInputs || count > node.kMostInputs) {
                throw std::invalid_argument("relief: term '" + term.name + "' has a wrong number of inputs");
            }
            part.octaves = node.octaves(dimensions);
        },
        term.node);
    part.amplitude_from.resize(part.octaves.size());
    double sum = 0.0;
    for (std::size_t k = part.octaves.size(); k-- > 0;) part.amplitude_from[k] = sum += part.octaves[k].amplitude;
    return part;
}

std::size_t evaluations_of(const std::vector<ReliefPart>& parts, std::size_t index) {
    std::size_t count = parts[index].octaves.size();
    for (const std::size_t input : parts[index].inputs) count += evaluations_of(parts, input);
    return count;
}

}  // namespace

Relief::Relief(std::span<const ReliefTerm> terms, int dimensions) : dimensions_(dimensions) {
    if (terms.empty()) throw std::invalid_argument("relief: no terms");
    for (std::size_t i = 0; i < terms.size(); ++i) parts_.push_back(make_part(terms, i, dimensions));
    for (std::size_t i = 0; i < terms.size(); ++i) certificates_.push_back(certificate_of(parts_, i, dimensions));
    evaluations_ = evaluations_of(parts_, parts_.size() - 1);
}

ReliefJet Relief::jet(const glm::dvec3& x) const {
    return JetNumbers::of(parts_, parts_.size() - 1, dimensions_, {.at = x});
}

double Relief::finest_frequency() const {
    double finest = 0.0;
    for (const ReliefPart& part : parts_) {
        for (const Octave& octave : part.octaves) {
            if (octave.amplitude != 0.0) finest = std::max(finest, octave.frequency);
        }
    }
    return finest;
}

}  // namespace strata::noise
