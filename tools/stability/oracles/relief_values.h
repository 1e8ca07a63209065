// The values of composed reliefs, read independently from the written definitions of their terms. Shares no code with
// the project but the terms' parameters. Surface-local coordinates; planar: noise of (x, z).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "tools/stability/oracles/relief_shapes.h"

namespace strata::oracle {

class ReliefValues {
  public:
    ReliefValues(const std::vector<noise::ReliefTerm>& terms, bool is_planar) : planar_(is_planar) {
        for (const noise::ReliefTerm& term : terms) {
            last_ = term.name;
            terms_[term.name] = term;
            std::visit([&](const auto& node) { prepare(term.name, node); }, term.node);
        }
    }

    double value(const Vec& p) const { return value_of(last_, p); }

  protected:
    using Octaves = std::vector<OracleOctave>;

    double peak() const { return planar_ ? 0.6619 : 1.0364; }

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

    void prepare(const std::string&, const noise::Curve&) {}
    void prepare(const std::string&, const noise::Terraces&) {}
    void prepare(const std::string&, const noise::Product&) {}
    void prepare(const std::string&, const noise::Blend&) {}
    void prepare(const std::string&, const noise::Highest&) {}
    void prepare(const std::string&, const noise::Lowest&) {}
    void prepare(const std::string&, const noise::Ramp&) {}

    void prepare(const std::string& name, const noise::Billow& node) {
        octaves_[name] = {octaves_of(node.parameters, node.parameters.seed)};
    }

    void prepare(const std::string& name, const noise::Hybrid& node) {
        octaves_[name] = {octaves_of(node.parameters, node.parameters.seed)};
    }

    void prepare(const std::string& name, const noise::Dunes& node) {
        noise::FbmParameters bends = node.parameters, heights = node.parameters;
        bends.amplitude = node.winding;
        bends.frequency = 1.0 / node.winding_size;
        heights.octaves = 1;
        heights.amplitude = 1.0;
        heights.frequency = 2.0 / node.winding_size;
        octaves_[name] = {octaves_of(bends, bends.seed), octaves_of(heights, heights.seed ^ 0xA0761D6478BD642Fu)};
    }

    void prepare(const std::string& name, const noise::Craters& node) {
        noise::FbmParameters p = node.parameters;
        p.amplitude *= node.size;
        p.gain /= p.lacunarity;
        p.frequency = 1.0 / node.size;
        octaves_[name] = {octaves_of(p, p.seed)};
    }

    // The k-th octave of a term whose lattices turn by so many degrees an octave.
    double noise_turned(const OracleOctave& o, double degrees, const Vec& p) const {
        const double a = degrees * 3.14159265358979323846 / 180.0;
        return noise(o, {std::cos(a) * p[0] + std::sin(a) * p[2], p[1], std::cos(a) * p[2] - std::sin(a) * p[0]});
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

    double value_of(const std::string& name, const Vec& p) const {
        return std::visit([&](const auto& node) { return read(name, node, p); }, terms_.at(name).node);
    }

    double read(const std::string& name, const noise::Fbm& node, const Vec& p) const {
        double total = 0.0, degrees = 0.0;
        for (const OracleOctave& o : octaves_.at(name).front()) {
            total += o.amplitude * noise_turned(o, degrees, p);
            degrees += node.turn_deg;
        }
        return total;
    }

    double read(const std::string& name, const noise::Ridged& node, const Vec& p) const {
        return weighed(
            name, node, [&](double v) { return std::pow(1.0 - std::hypot(v, node.roundness), 2.0); }, p);
    }

    // Of octaves that weigh one another, shape(v) in [0, 1] with slopes up to `steep`.
    template <class Node, class Shape>
    double weighed(const std::string& name, const Node& node, const Shape& shape, const Vec& p) const {
        double total = 0.0, weight = 1.0, degrees = 0.0;
        for (const OracleOctave& o : octaves_.at(name).front()) {
            const double part = weight * shape(noise_turned(o, degrees, p) / peak()), u = node.feedback * part;
            total += o.amplitude * part;
            if (node.feedback > 0.0) weight = u < 2.0 ? u - u * u / 4.0 : 1.0;
            degrees += node.turn_deg;
        }
        return total;
    }

    double read(const std::string& name, const noise::Billow& node, const Vec& p) const {
        const double e = node.roundness, most = std::hypot(1.0, e) - e;
        return weighed(
            name, node, [&](double v) { return (std::hypot(v, e) - e) / most; }, p);
    }

    double read(const std::string& name, const noise::Hybrid& node, const Vec& p) const {
        return weighed(
            name, node, [](double v) { return std::pow((1.0 + v) / 2.0, 2.0); }, p);
    }

    double input(const std::string& name, std::size_t i, const Vec& p) const {
        return value_of(terms_.at(name).of.at(i), p);
    }

    double read(const std::string& name, const noise::Curve& node, const Vec& p) const {
        return through_knots({node.from.begin(), node.from.end()}, node.to, input(name, 0, p));
    }

    double read(const std::string& name, const noise::Terraces& node, const Vec& p) const {
        const double v = input(name, 0, p), f = v / node.step - std::floor(v / node.step);
        return v + node.strength * node.step * (3.0 * f * f - 2.0 * f * f * f - f);
    }

    double read(const std::string& name, const noise::Product& node, const Vec& p) const {
        double all = node.scale;
        for (std::size_t i = 0; i < terms_.at(name).of.size(); ++i) all *= input(name, i, p);
        return all;
    }

    double read(const std::string& name, const noise::Blend& node, const Vec& p) const {
        const std::size_t mask = terms_.at(name).of.size() - 1;
        const double t = std::clamp((input(name, mask, p) - node.from) / (node.to - node.from), 0.0, 1.0);
        const double s = t * t * (3.0 - 2.0 * t), a = mask == 2 ? input(name, 0, p) : 0.0;
        return a * (1.0 - s) + s * input(name, mask - 1, p);
    }

    double read(const std::string& name, const noise::Highest& node, const Vec& p) const {
        const double a = input(name, 0, p), b = input(name, 1, p);
        return 0.5 * (a + b + std::hypot(a - b, node.softness));
    }

    double read(const std::string& name, const noise::Lowest& node, const Vec& p) const {
        const double a = input(name, 0, p), b = input(name, 1, p);
        return 0.5 * (a + b - std::hypot(a - b, node.softness));
    }

    double read(const std::string&, const noise::Ramp& node, const Vec& p) const {
        const double turn = node.azimuth_deg * 3.14159265358979323846 / 180.0;
        const double t =
            std::clamp((p[0] * std::sin(turn) + p[2] * std::cos(turn) - node.begin) / node.width, 0.0, 1.0);
        return node.height * t * t * (3.0 - 2.0 * t);
    }

    double read(const std::string& name, const noise::Dunes& node, const Vec& p) const {
        const double turn = node.azimuth_deg * 3.14159265358979323846 / 180.0;
        const auto& octaves = octaves_.at(name);
        const double phase =
            (p[0] * std::sin(turn) + p[2] * std::cos(turn)) / node.wavelength + sum(octaves[0], p) / peak();
        const double high = 1.0 - 0.5 * node.vary * (1.0 - sum(octaves[1], p) / peak());
        return node.height * high * dune(phase - std::floor(phase), node.lee, node.brink);
    }

    double read(const std::string& name, const noise::Craters& node, const Vec& p) const {
        double total = 0.0;
        for (const OracleOctave& o : octaves_.at(name).front()) {
            const double x = o.frequency * p[0] + o.offset[0], z = o.frequency * p[2] + o.offset[1];
            // All corners about, the far ones to see that they do not count.
            for (int i = -1; i <= 2; ++i) {
                for (int j = -1; j <= 2; ++j) {
                    const double cx = std::floor(x) + i, cz = std::floor(z) + j;
                    std::uint32_t hash = (detail::plane_hash(static_cast<std::int64_t>(cx), o.key[0]) ^
                                          detail::plane_hash(static_cast<std::int64_t>(cz), o.key[1])) *
                                         2246822519u;
                    hash = (hash ^ (hash >> 15)) * 2654435761u;
                    const double radius = 0.1 + 0.2 * std::pow((hash >> 16 & 255u) / 255.0, 2.0);
                    const double depth = node.worn + (1.0 - node.worn) * std::pow((hash >> 24) / 255.0, 2.0);
                    const double dx = x - cx - ((hash & 255u) / 510.0 - 0.25);
                    const double dz = z - cz - ((hash >> 8 & 255u) / 510.0 - 0.25);
                    total += o.amplitude * depth * radius * pit((dx * dx + dz * dz) / (radius * radius));
                }
            }
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

    double read(const std::string& name, const noise::Sum& node, const Vec& p) const {
        double total = 0.0;
        for (const std::string& input : terms_.at(name).of) total += value_of(input, p);
        return node.offset + node.scale * total;
    }

    double read(const std::string& name, const noise::Envelope& node, const Vec& p) const {
        const double mass = mass_of(node, p);
        if (terms_.at(name).of.empty()) return node.lift * mass;
        return (node.least + (1.0 - node.least) * mass) * value_of(terms_.at(name).of.front(), p) + node.lift * mass;
    }

    double read(const std::string& name, const noise::Fill& node, const Vec& p) const {
        const double d = value_of(terms_.at(name).of.front(), p) - node.floor;
        return node.floor + 0.5 * (d + std::hypot(d, node.softness));
    }

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
            const double pull =
                -3.14159265358979323846 * node.branching * node.bands * o.frequency * depth * wave[1] / even;
            gx += pull * dx;
            gz += pull * dz;
        }
        return height;
    }

    bool planar_;
    std::string last_;
    std::map<std::string, noise::ReliefTerm> terms_;
    std::map<std::string, std::vector<Octaves>> octaves_;
};

}  // namespace strata::oracle
