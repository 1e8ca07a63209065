// An independent reading of composed reliefs, from the written definitions of their terms. Shares no code with the
// project but the terms' parameters. Surface-local coordinates; planar: noise of (x, z).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

    // The relief lies between `low` and `high`, which are `slope`-Lipschitz: what holds whatever gullies carve.
    struct Rough {
        double low, high, slope;
    };
    Rough rough(const Vec& p) const { return rough_of(last_, p); }

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
    void prepare(const std::string&, const noise::Envelope&) {}
    void prepare(const std::string&, const noise::Fill&) {}
    void prepare(const std::string& name, const noise::Gullies& node) {
        noise::FbmParameters p = node.parameters;
        p.amplitude *= node.size;
        p.frequency = 1.0 / node.size;
        octaves_[name] = {octaves_of(p, p.seed)};
    }

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

    double read(const std::string& name, const noise::Envelope& node, const Vec& p) const {
        const double mass = mass_of(node, p);
        return (node.least + (1.0 - node.least) * mass) * value_of(terms_.at(name).of.front(), p) + node.lift * mass;
    }
    double steepest(const std::string& name, const noise::Envelope& node) const {
        return slope_of(terms_.at(name).of.front()) + mass_slope(node) * (std::abs(node.lift) + largest(name));
    }
    static double mass_of(const noise::Envelope& node, const Vec& p) {
        return std::pow(
            1.0 + std::pow((p[0] - node.x) / node.x_size, 2.0) + std::pow((p[2] - node.z) / node.z_size, 2.0), -2.0);
    }
    static double mass_slope(const noise::Envelope& node) { return 1.1 / std::min(node.x_size, node.z_size); }

    // A bound of what an envelope weakens.
    double largest(const std::string& name) const {
        double most = 0.0;
        for (const auto& [other, octaves] : octaves_)
            for (const Octaves& each : octaves)
                for (const OracleOctave& o : each) most += 2.0 * std::abs(o.amplitude);
        return terms_.at(name).of.empty() ? 0.0 : most + 10.0;
    }

    double read(const std::string& name, const noise::Fill& node, const Vec& p) const {
        const double d = value_of(terms_.at(name).of.front(), p) - node.floor;
        return node.floor + 0.5 * (d + std::hypot(d, node.softness));
    }
    double steepest(const std::string& name, const noise::Fill&) const { return slope_of(terms_.at(name).of.front()); }

    double read(const std::string& name, const noise::Gullies& node, const Vec& p) const {
        const std::string& guide = terms_.at(name).of.back();
        const double step = 0.15 * node.size, base = value_of(terms_.at(name).of.front(), p), here = value_of(guide, p);
        double gx = (value_of(guide, {p[0] + step, p[1], p[2]}) - here) / step;
        double gz = (value_of(guide, {p[0], p[1], p[2] + step}) - here) / step;
        double height = base;
        for (const OracleOctave& o : octaves_.at(name).front()) {
            const double steep = std::hypot(gx, gz, 0.08), slope = (steep - 0.08) / node.steepest;
            const double depth = o.amplitude * node.steepest * (slope < 2.0 ? slope - slope * slope / 4.0 : 1.0);
            const double dx = -gz / steep, dz = gx / steep;
            const std::array<double, 2> wave = stripe(o, p, dx, dz, node.bands);
            const double even = std::hypot(wave[0], wave[1], 0.25);
            height -= depth * 0.5 * (1.0 - wave[0] / even);
            const double pull = -3.14159265358979323846 * node.bands * o.frequency * depth * wave[1] / even;
            gx += pull * dx;
            gz += pull * dz;
        }
        return height;
    }
    // No use is made of how steep gullies are: rough() tells what they leave.
    double steepest(const std::string&, const noise::Gullies&) const { return std::numeric_limits<double>::infinity(); }

    static std::array<double, 2> stripe(const OracleOctave& o, const Vec& p, double dx, double dz, double bands) {
        const double x = o.frequency * p[0] + o.offset[0], z = o.frequency * p[2] + o.offset[1];
        const double cx = std::floor(x), cz = std::floor(z);
        std::array<double, 2> sum{};
        for (int i = 0; i < 2; ++i) {
            for (int j = 0; j < 2; ++j) {
                const std::uint32_t hash = (detail::plane_hash(static_cast<std::int64_t>(cx) + i, o.key[0]) ^
                                            detail::plane_hash(static_cast<std::int64_t>(cz) + j, o.key[1])) *
                                           2246822519u;
                const double u = detail::smooth(x - cx), v = detail::smooth(z - cz);
                const double weight = (i == 0 ? 1.0 - u : u) * (j == 0 ? 1.0 - v : v);
                const double turns = bands * (dx * (x - cx - i) + dz * (z - cz - j)) + (hash >> 8) / 16777216.0;
                sum[0] += weight * std::cos(6.283185307179586 * turns);
                sum[1] += weight * std::sin(6.283185307179586 * turns);
            }
        }
        return sum;
    }

    Rough rough_of(const std::string& name, const Vec& p) const {
        return std::visit([&](const auto& node) { return guess(name, node, p); }, terms_.at(name).node);
    }
    template <class Node>
    Rough guess(const std::string& name, const Node& node, const Vec& p) const {
        const double value = read(name, node, p);
        return {value, value, steepest(name, node)};
    }
    Rough guess(const std::string& name, const noise::Warp& node, const Vec& p) const {
        double displacement = 0.0;
        Vec there = p;
        const auto& components = octaves_.at(name);
        for (std::size_t c = 0; c < components.size(); ++c) {
            there[planar_ ? 2 * c : c] += sum(components[c], p) / peak();
            displacement += steepness(components[c]) / peak();
        }
        (void)node;
        Rough of = rough_of(terms_.at(name).of.front(), there);
        of.slope *= 1.0 + displacement;
        return of;
    }
    Rough guess(const std::string& name, const noise::Sum& node, const Vec& p) const {
        Rough all{node.offset, node.offset, 0.0};
        for (const std::string& input : terms_.at(name).of) {
            const Rough of = rough_of(input, p);
            all.low += node.scale * (node.scale < 0.0 ? of.high : of.low);
            all.high += node.scale * (node.scale < 0.0 ? of.low : of.high);
            all.slope += std::abs(node.scale) * of.slope;
        }
        return all;
    }
    Rough guess(const std::string& name, const noise::Envelope& node, const Vec& p) const {
        const Rough of = rough_of(terms_.at(name).of.front(), p);
        const double mass = mass_of(node, p), weight = node.least + (1.0 - node.least) * mass;
        return {weight * of.low + node.lift * mass, weight * of.high + node.lift * mass,
                of.slope + mass_slope(node) * (std::abs(node.lift) + largest(name))};
    }
    Rough guess(const std::string& name, const noise::Fill& node, const Vec& p) const {
        Rough of = rough_of(terms_.at(name).of.front(), p);
        for (double* height : {&of.low, &of.high}) {
            const double d = *height - node.floor;
            *height = node.floor + 0.5 * (d + std::hypot(d, node.softness));
        }
        return of;
    }
    Rough guess(const std::string& name, const noise::Gullies& node, const Vec& p) const {
        Rough of = rough_of(terms_.at(name).of.front(), p);
        for (const OracleOctave& o : octaves_.at(name).front()) of.low -= o.amplitude * node.steepest;
        return of;
    }

    bool planar_;
    std::string last_;
    std::map<std::string, noise::ReliefTerm> terms_;
    std::map<std::string, std::vector<Octaves>> octaves_;
};

}  // namespace strata::oracle
