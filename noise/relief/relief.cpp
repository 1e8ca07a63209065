#include "noise/relief/relief.h"

#include <algorithm>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "noise/relief/nodes/all.h"

namespace strata::noise {

namespace {

std::size_t place_of(std::span<const ReliefTerm> before, const std::string& name) {
    const auto found = std::ranges::find(before, name, &ReliefTerm::name);
    if (found == before.end()) throw std::invalid_argument("relief: no term before has the name '" + name + "'");
    return static_cast<std::size_t>(found - before.begin());
}

std::vector<PlanTurn> turns_of(double degrees, std::size_t octaves) {
    std::vector<PlanTurn> turns;
    for (std::size_t k = 0; k < octaves && degrees != 0.0; ++k) {
        const double angle = degrees * (std::numbers::pi / 180.0) * static_cast<double>(k);
        turns.push_back({std::cos(angle), std::sin(angle)});
    }
    return turns;
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
    std::visit(
        [&](auto& node) {
            if constexpr (requires { node.prepare(); }) node.prepare();
            if constexpr (requires { node.turn_deg; }) part.turns = turns_of(node.turn_deg, part.octaves.size());
        },
        part.node);
    part.amplitude_from.resize(part.octaves.size());
    double sum = 0.0;
    for (std::size_t k = part.octaves.size(); k-- > 0;) part.amplitude_from[k] = sum += part.octaves[k].amplitude;
    return part;
}

// How often the formula of a part reads its i-th input.
std::size_t reads_of(const ReliefPart& part, std::size_t i) {
    return std::visit(
        [&]<class Node>(const Node&) -> std::size_t {
            if constexpr (requires { Node::kReadsOfLastInput; }) {
                if (i + 1 == part.inputs.size()) return Node::kReadsOfLastInput;
            }
            return 1;
        },
        part.node);
}

// Terms that read others several times, which do the same, are read more often than any patience.
constexpr double kMostReadings = 1e5;

std::string too_many_readings(const std::string& name, double readings) {
    std::ostringstream text;
    text << "relief." << name << ".of: a point of it takes " << readings
         << " readings of terms, allowed: 100000; name terms fewer times";
    return text.str();
}

// Of each part, by those in front of it: what it takes itself, and what its inputs take as often as it reads them.
template <class Own>
std::vector<double> totals(const std::vector<ReliefPart>& parts, const Own& own) {
    std::vector<double> of;
    for (const ReliefPart& part : parts) {
        double sum = own(part);
        for (std::size_t i = 0; i < part.inputs.size(); ++i) {
            sum += static_cast<double>(reads_of(part, i)) * of[part.inputs[i]];
        }
        of.push_back(sum);
    }
    return of;
}

}  // namespace

Relief::Relief(std::span<const ReliefTerm> terms, int dimensions) : dimensions_(dimensions) {
    if (terms.empty()) throw std::invalid_argument("relief: no terms");
    for (std::size_t i = 0; i < terms.size(); ++i) parts_.push_back(make_part(terms, i, dimensions));
    const auto readings = totals(parts_, [](const ReliefPart&) { return 1.0; });
    for (std::size_t i = 0; i < terms.size(); ++i) {
        if (readings[i] > kMostReadings) throw std::invalid_argument(too_many_readings(terms[i].name, readings[i]));
        certificates_.push_back(certificate_of(parts_, i, dimensions));
    }
    const auto octaves = totals(parts_, [](const ReliefPart& p) { return static_cast<double>(p.octaves.size()); });
    evaluations_ = static_cast<std::size_t>(octaves.back());
}

double Relief::finest_frequency() const {
    double finest = 0.0;
    for (const ReliefPart& part : parts_) {
        for (const Octave& octave : part.octaves) finest = std::max(finest, octave.frequency);
        std::visit(
            [&](const auto& node) {
                if constexpr (requires { node.repeats(); }) finest = std::max(finest, node.repeats());
            },
            part.node);
    }
    return finest;
}

double Relief::coarsest_frequency() const {
    double coarsest = 0.0;
    for (const ReliefPart& part : parts_) {
        for (const Octave& octave : part.octaves) {
            if (octave.amplitude == 0.0) continue;
            coarsest = coarsest == 0.0 ? octave.frequency : std::min(coarsest, octave.frequency);
        }
    }
    return coarsest == 0.0 ? 1.0 : coarsest;
}

}  // namespace strata::noise
