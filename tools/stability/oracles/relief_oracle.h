// An independent reading of composed reliefs with bounds, for the judgement of rays.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "tools/stability/oracles/relief_values.h"

namespace strata::oracle {

class ReliefOracle : public ReliefValues {
  public:
    using ReliefValues::ReliefValues;

    // The relief lies between `low` and `high`, which are `slope`-Lipschitz: what holds whatever gullies carve.
    struct Rough {
        double low, high, slope;
    };
    Rough rough(const Vec& p) const { return rough_of(last_, p); }

    // No less than the relief's Lipschitz constant.
    double slope() const { return slope_of(last_); }

  private:
    double noise_slope() const { return planar_ ? kMaxSlope2 : kMaxSlope3; }

    double steepness(const Octaves& octaves) const {
        double total = 0.0;
        for (const OracleOctave& o : octaves) total += o.amplitude * o.frequency * noise_slope();
        return total;
    }

    double slope_of(const std::string& name) const {
        return std::visit([&](const auto& node) { return steepest(name, node); }, terms_.at(name).node);
    }

    double steepest(const std::string& name, const noise::Fbm&) const { return steepness(octaves_.at(name).front()); }

    // The crest's slope by v is below 2, crest and weight are at most 1, the clip's slope too.
    double steepest(const std::string& name, const noise::Ridged& node) const {
        return weighed_slope(name, node.feedback, 2.0);
    }

    double weighed_slope(const std::string& name, double feedback, double steep) const {
        double total = 0.0, weight = 0.0;
        for (const OracleOctave& o : octaves_.at(name).front()) {
            const double term = weight + steep * o.frequency * noise_slope() / peak();
            total += o.amplitude * term;
            weight = feedback * term;
        }
        return total;
    }

    double steepest(const std::string& name, const noise::Billow& node) const {
        return weighed_slope(name, node.feedback, 1.0 / (std::hypot(1.0, node.roundness) - node.roundness));
    }

    double steepest(const std::string& name, const noise::Hybrid& node) const {
        return weighed_slope(name, node.feedback, 1.0);
    }

    // A monotone piece is nowhere steeper than three of its chord.
    double steepest(const std::string& name, const noise::Curve& node) const {
        return 3.0 * steepest_chord(node) * slope_of(terms_.at(name).of.front());
    }

    double steepest(const std::string& name, const noise::Terraces& node) const {
        return (1.0 + 0.5 * node.strength) * slope_of(terms_.at(name).of.front());
    }

    // The other factors as large as they get.
    double steepest(const std::string& name, const noise::Product& node) const {
        const std::vector<std::string>& of = terms_.at(name).of;
        double total = 0.0;
        for (std::size_t i = 0; i < of.size(); ++i) {
            double term = std::abs(node.scale) * slope_of(of[i]);
            for (std::size_t j = 0; j < of.size(); ++j)
                if (j != i) term *= size_of(of[j]);
            total += term;
        }
        return total;
    }

    double steepest(const std::string& name, const noise::Blend& node) const {
        const std::vector<std::string>& of = terms_.at(name).of;
        double steep = 0.0, apart = 0.0;
        for (std::size_t i = 0; i + 1 < of.size(); ++i) {
            steep = std::max(steep, slope_of(of[i]));
            apart += size_of(of[i]);
        }
        return steep + apart * 1.5 * slope_of(of.back()) / std::abs(node.to - node.from);
    }

    template <class Either>
    requires std::same_as<Either, noise::Highest> || std::same_as<Either, noise::Lowest>
    double steepest(const std::string& name, const Either&) const {
        return std::max(slope_of(terms_.at(name).of[0]), slope_of(terms_.at(name).of[1]));
    }

    double steepest(const std::string&, const noise::Ramp& node) const {
        return 1.5 * std::abs(node.height) / node.width;
    }

    // The profile's steepest part is the slip face or the end of the windward side.
    double steepest(const std::string& name, const noise::Dunes& node) const {
        const double fall = 1.3 / node.lee + 0.5, rise = 1.5 / (1.0 - node.lee);
        const auto& octaves = octaves_.at(name);
        const double phase = 1.0 / node.wavelength + steepness(octaves[0]) / peak();
        return node.height * (std::max(fall, rise) * 1.3 * phase + 0.5 * node.vary * steepness(octaves[1]) / peak());
    }

    double steepest(const std::string& name, const noise::Craters&) const {
        double total = 0.0;
        for (const OracleOctave& o : octaves_.at(name).front()) total += 4.0 * 0.7 * o.amplitude * o.frequency;
        return total;
    }

    // At least the largest size of a term's values.
    double size_of(const std::string& name) const {
        return std::visit([&](const auto& node) { return largest_of(name, node); }, terms_.at(name).node);
    }

    double amplitudes(const std::string& name) const {
        double total = 0.0;
        for (const OracleOctave& o : octaves_.at(name).front()) total += o.amplitude;
        return total;
    }

    // Octaves, each at most 1.04 times its amplitude. A kind without a line of its own here does not
    // compile.
    template <class Noise>
    requires std::same_as<Noise, noise::Fbm> || std::same_as<Noise, noise::Ridged> ||
        std::same_as<Noise, noise::Billow> || std::same_as<Noise, noise::Hybrid> || std::same_as<Noise, noise::Craters>
    double largest_of(const std::string& name, const Noise&) const { return 1.1 * amplitudes(name); }

    template <class Lone>
    requires std::same_as<Lone, noise::Dunes> || std::same_as<Lone, noise::Ramp>
    double largest_of(const std::string&, const Lone& node) const { return std::abs(node.height); }

    // Those that give one of what they are made of, or a mean.
    template <class Mean>
    requires std::same_as<Mean, noise::Warp> || std::same_as<Mean, noise::Blend>
    double largest_of(const std::string& name, const Mean&) const { return size_of_inputs(name); }

    template <class Either>
    requires std::same_as<Either, noise::Highest> || std::same_as<Either, noise::Lowest>
    double largest_of(const std::string& name, const Either& node) const {
        return size_of_inputs(name) + node.softness;
    }

    double largest_of(const std::string& name, const noise::Sum& node) const {
        return std::abs(node.scale) * size_of_inputs(name) + std::abs(node.offset);
    }

    double largest_of(const std::string& name, const noise::Product& node) const {
        double product = std::abs(node.scale);
        for (const std::string& of : terms_.at(name).of) product *= size_of(of);
        return product;
    }

    double largest_of(const std::string& name, const noise::Envelope& node) const {
        return size_of_inputs(name) + std::abs(node.lift);
    }

    double largest_of(const std::string& name, const noise::Fill& node) const {
        return size_of_inputs(name) + std::abs(node.floor) + node.softness;
    }

    double largest_of(const std::string& name, const noise::Terraces& node) const {
        return size_of_inputs(name) + 0.1 * node.step;
    }

    double largest_of(const std::string& name, const noise::Curve& node) const {
        const double reach = size_of_inputs(name) + std::abs(node.from[0]) + std::abs(node.from.back());
        double most = steepest_chord(node) * 3.0 * reach;
        for (const double y : node.to) most += std::abs(y);
        return most;
    }

    double largest_of(const std::string& name, const noise::Gullies& node) const {
        return size_of_inputs(name) + node.steepest * amplitudes(name) * 2.0;
    }

    // Of all together.
    double size_of_inputs(const std::string& name) const {
        double total = 0.0;
        for (const std::string& of : terms_.at(name).of) total += size_of(of);
        return total;
    }

    static double steepest_chord(const noise::Curve& node) {
        double most = 0.0;
        for (std::size_t i = 0; i + 1 < node.from.size(); ++i) {
            most = std::max(most, std::abs((node.to[i + 1] - node.to[i]) / (node.from[i + 1] - node.from[i])));
        }
        return most;
    }

    double steepest(const std::string& name, const noise::Warp&) const {
        double displacement = 0.0;
        for (const Octaves& component : octaves_.at(name)) displacement += steepness(component) / peak();
        return slope_of(terms_.at(name).of.front()) * (1.0 + displacement);
    }

    double steepest(const std::string& name, const noise::Sum& node) const {
        double total = 0.0;
        for (const std::string& input : terms_.at(name).of) total += slope_of(input);
        return std::abs(node.scale) * total;
    }

    double steepest(const std::string& name, const noise::Envelope& node) const {
        if (terms_.at(name).of.empty()) return mass_slope(node) * std::abs(node.lift);
        return slope_of(terms_.at(name).of.front()) + mass_slope(node) * (std::abs(node.lift) + input_size(name));
    }

    static double mass_slope(const noise::Envelope& node) { return 1.1 / std::min(node.x_size, node.z_size); }

    // A bound of what an envelope weakens.
    double input_size(const std::string& name) const { return size_of(terms_.at(name).of.front()); }

    double steepest(const std::string& name, const noise::Fill&) const { return slope_of(terms_.at(name).of.front()); }

    // No use is made of how steep gullies are: rough() tells what they leave.
    double steepest(const std::string&, const noise::Gullies&) const { return std::numeric_limits<double>::infinity(); }

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
        if (terms_.at(name).of.empty()) {
            return {node.lift * mass_of(node, p), node.lift * mass_of(node, p), steepest(name, node)};
        }
        const Rough of = rough_of(terms_.at(name).of.front(), p);
        const double mass = mass_of(node, p), weight = node.least + (1.0 - node.least) * mass;
        return {weight * of.low + node.lift * mass, weight * of.high + node.lift * mass,
                of.slope + mass_slope(node) * (std::abs(node.lift) + input_size(name))};
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
};

}  // namespace strata::oracle
