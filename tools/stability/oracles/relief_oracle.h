// An independent reading of composed reliefs, from the written definitions of their terms. Shares no code with the
// project but the terms' parameters. Surface-local coordinates; planar: noise of (x, z).
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "noise/relief/relief.h"
#include "tools/stability/oracles/field_oracle.h"

namespace strata::oracle {

class ReliefOracle {
  public:
    ReliefOracle(const std::vector<noise::ReliefTerm>& terms, bool is_planar) : planar_(is_planar) {
        for (const noise::ReliefTerm& term : terms) {
            last_ = term.name;
            terms_[term.name] = term;
            std::visit([&](const auto& node) { prepare(term.name, node); }, term.node);
        }
    }

    double value(const Vec& p) const { return value_of(last_, p); }

    // No less than the relief's Lipschitz constant.
    double slope() const { return slope_of(last_); }

  private:
    using Octaves = std::vector<OracleOctave>;

    double peak() const { return planar_ ? 0.6619 : 1.0364; }
    double noise_slope() const { return planar_ ? kMaxSlope2 : kMaxSlope3; }

    Octaves octaves_of(const noise::FbmParameters& p, std::uint64_t seed) const {
        Shape shape;
        shape.octaves = p.octaves;
        shape.lacunarity = p.lacunarity;
        shape.gain = p.gain;
        shape.amplitude = p.amplitude;
        shape.frequency = p.frequency;
        shape.seed = seed;
        return FieldOracle(shape).octaves();
    }

    void prepare(const std::string& name, const noise::Fbm& node) {
        octaves_[name] = {octaves_of(node.parameters, node.parameters.seed)};
    }
    void prepare(const std::string& name, const noise::Ridged& node) {
        octaves_[name] = {octaves_of(node.parameters, node.parameters.seed)};
    }
    void prepare(const std::string& name, const noise::Warp& node) {
        for (std::uint64_t c = 1; c <= (planar_ ? 2u : 3u); ++c) {
            octaves_[name].push_back(octaves_of(node.parameters, node.parameters.seed ^ (c * 11400714819323198485u)));
        }
    }
    void prepare(const std::string&, const noise::Sum&) {}

    double noise(const OracleOctave& o, const Vec& p) const {
        const double w = o.frequency;
        if (planar_) return noise2<double>(o.key, w * p[0] + o.offset[0], w * p[2] + o.offset[1]);
        return noise3<double>(o.key, w * p[0] + o.offset[0], w * p[1] + o.offset[1], w * p[2] + o.offset[2]);
    }

    double sum(const Octaves& octaves, const Vec& p) const {
        double total = 0.0;
        for (const OracleOctave& o : octaves) total += o.amplitude * noise(o, p);
        return total;
    }

    double steepness(const Octaves& octaves) const {
        double total = 0.0;
        for (const OracleOctave& o : octaves) total += o.amplitude * o.frequency * noise_slope();
        return total;
    }

    double value_of(const std::string& name, const Vec& p) const {
        return std::visit([&](const auto& node) { return read(name, node, p); }, terms_.at(name).node);
    }
    double slope_of(const std::string& name) const {
        return std::visit([&](const auto& node) { return steepest(name, node); }, terms_.at(name).node);
    }

    double read(const std::string& name, const noise::Fbm&, const Vec& p) const {
        return sum(octaves_.at(name).front(), p);
    }
    double steepest(const std::string& name, const noise::Fbm&) const { return steepness(octaves_.at(name).front()); }

    double read(const std::string& name, const noise::Ridged& node, const Vec& p) const {
        double total = 0.0, weight = 1.0;
        for (const OracleOctave& o : octaves_.at(name).front()) {
            const double v = noise(o, p) / peak();
            const double crest = std::pow(1.0 - std::hypot(v, node.roundness), 2.0);
            total += o.amplitude * weight * crest;
            if (node.feedback > 0.0) {
                const double u = node.feedback * weight * crest;
                weight = u < 2.0 ? u - u * u / 4.0 : 1.0;
            }
        }
        return total;
    }
    // The crest's slope by v is below 2, crest and weight are at most 1, the clip's slope too.
    double steepest(const std::string& name, const noise::Ridged& node) const {
        double total = 0.0, weight = 0.0;
        for (const OracleOctave& o : octaves_.at(name).front()) {
            const double term = weight + 2.0 * o.frequency * noise_slope() / peak();
            total += o.amplitude * term;
            weight = node.feedback * term;
        }
        return total;
    }

    double read(const std::string& name, const noise::Warp&, const Vec& p) const {
        Vec there = p;
        const auto& components = octaves_.at(name);
        for (std::size_t c = 0; c < components.size(); ++c)
            there[planar_ ? 2 * c : c] += sum(components[c], p) / peak();
        return value_of(terms_.at(name).of.front(), there);
    }
    double steepest(const std::string& name, const noise::Warp&) const {
        double displacement = 0.0;
        for (const Octaves& component : octaves_.at(name)) displacement += steepness(component) / peak();
        return slope_of(terms_.at(name).of.front()) * (1.0 + displacement);
    }

    double read(const std::string& name, const noise::Sum& node, const Vec& p) const {
        double total = 0.0;
        for (const std::string& input : terms_.at(name).of) total += value_of(input, p);
        return node.offset + node.scale * total;
    }
    double steepest(const std::string& name, const noise::Sum& node) const {
        double total = 0.0;
        for (const std::string& input : terms_.at(name).of) total += slope_of(input);
        return std::abs(node.scale) * total;
    }

    bool planar_;
    std::string last_;
    std::map<std::string, noise::ReliefTerm> terms_;
    std::map<std::string, std::vector<Octaves>> octaves_;
};

}  // namespace strata::oracle
