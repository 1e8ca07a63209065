// Random compositions of relief terms, and the judgement of rays through them by an oracle that reads them itself.
#pragma once

#include <string>
#include <vector>

#include "tests/trace/ray_families.h"
#include "tools/stability/oracles/relief_oracle.h"

namespace strata::trace_test {

// Octaves whose steepest one has a slope of about 0.5 to 3.
inline noise::FbmParameters random_octaves(Random& random, int most, double size) {
    noise::FbmParameters p;
    p.octaves = 1 + static_cast<int>(random() % static_cast<unsigned>(most));
    p.lacunarity = uniform(random, 1.8, 2.4);
    p.gain = uniform(random, 0.35, 0.55);
    p.frequency = log_uniform(random, 0.15, 1.5);
    p.amplitude = size * uniform(random, 0.1, 0.4) / p.frequency;
    p.seed = random() >> 1;
    return p;
}

inline noise::ReliefNode random_leaf_node(Random& random) {
    const double feedback = random() % 3 == 0 ? 0.0 : uniform(random, 0.5, 3.0);
    const noise::FbmParameters octaves = random_octaves(random, 6, 1.0);
    const double turn = random() % 3 == 0 ? uniform(random, -180.0, 180.0) : 0.0;
    switch (random() % 5) {
        case 0:
        case 1:
            return noise::Fbm{octaves, turn};
        case 2:
            return noise::Billow{octaves, log_uniform(random, 0.01, 0.4), feedback, turn};
        case 3:
            return noise::Hybrid{octaves, feedback, turn};
        default:
            return noise::Ridged{octaves, log_uniform(random, 0.01, 0.4), feedback, turn};
    }
}

inline noise::ReliefTerm random_leaf(Random& random, std::string name) {
    return {std::move(name), {}, random_leaf_node(random)};
}

// Through 2 to 8 points, flat and steep by turns, that rise but for one case in four.
inline noise::Curve random_curve(Random& random) {
    noise::Curve curve;
    curve.from = {uniform(random, -0.6, -0.2)};
    curve.to = {uniform(random, -0.5, 0.0)};
    const bool turns = random() % 4 == 0;
    for (std::size_t i = 1 + random() % 7; i > 0; --i) {
        const double width = log_uniform(random, 0.02, 0.3);
        curve.from.push_back(curve.from.back() + width);
        const double rise = width * (i % 2 == 0 ? uniform(random, 0.0, 0.2) : uniform(random, 0.5, 4.0));
        curve.to.push_back(curve.to.back() + (turns && random() % 2 == 0 ? -rise : rise));
    }
    return curve;
}

// One that brings another relief's heights to other ones.
inline noise::ReliefNode random_profile(Random& random) {
    if (random() % 2 == 0) return random_curve(random);
    return noise::Terraces{log_uniform(random, 0.03, 0.4), uniform(random, 0.0, 1.0)};
}

// One that takes two reliefs.
inline noise::ReliefNode random_pairing(Random& random) {
    switch (random() % 5) {
        case 0:
            return noise::Highest{log_uniform(random, 1e-3, 0.3)};
        case 1:
            return noise::Lowest{log_uniform(random, 1e-3, 0.3)};
        case 2:
            return noise::Product{uniform(random, -1.0, 1.0)};
        case 3: {
            const double from = uniform(random, -0.2, 0.4);
            return noise::Blend{from, from + (random() % 2 == 0 ? 1 : -1) * log_uniform(random, 0.05, 0.5)};
        }
        default:
            return noise::Sum{uniform(random, -1.0, 1.0), uniform(random, -0.2, 0.2)};
    }
}

inline noise::Dunes random_dunes(Random& random) {
    noise::Dunes dunes;
    dunes.wavelength = log_uniform(random, 0.3, 4.0);
    dunes.height = dunes.wavelength * uniform(random, 0.03, 0.2);
    dunes.azimuth_deg = uniform(random, -180.0, 180.0);
    dunes.lee = uniform(random, 0.2, 0.6);
    dunes.brink = log_uniform(random, 0.002, 0.05);
    dunes.winding = uniform(random, 0.0, 1.5);
    dunes.winding_size = dunes.wavelength * uniform(random, 1.5, 5.0);
    dunes.vary = uniform(random, 0.0, 1.0);
    dunes.parameters.octaves = 1 + static_cast<int>(random() % 3);
    dunes.parameters.seed = random() >> 1;
    return dunes;
}

inline noise::Craters random_craters(Random& random) {
    noise::Craters craters;
    craters.size = log_uniform(random, 0.3, 5.0);
    craters.parameters.octaves = 1 + static_cast<int>(random() % 5);
    craters.parameters.amplitude = uniform(random, 0.2, 2.0);
    craters.parameters.lacunarity = uniform(random, 1.5, 2.5);
    craters.parameters.seed = random() >> 1;
    craters.worn = uniform(random, 0.0, 1.0);
    return craters;
}

// Of height fields alone, of no other term.
inline noise::ReliefNode random_place(Random& random) {
    switch (random() % 4) {
        case 0:
            return noise::Ramp{uniform(random, -1.0, 1.0), uniform(random, -180.0, 180.0), uniform(random, -9.0, 9.0),
                               log_uniform(random, 1.0, 9.0)};
        case 1:
            return noise::Envelope{uniform(random, -5.0, 5.0),
                                   uniform(random, -5.0, 5.0),
                                   uniform(random, 2.0, 9.0),
                                   random() % 2 == 0 ? 1e6 : uniform(random, 2.0, 9.0),
                                   0.0,
                                   uniform(random, -0.9, 0.9)};
        case 2:
            return random_craters(random);
        default:
            return random_dunes(random);
    }
}

// One to six terms: a leaf, perhaps warped, perhaps joined with another one, perhaps through a curve.
inline std::vector<noise::ReliefTerm> random_relief(Random& random) {
    std::vector<noise::ReliefTerm> terms{random_leaf(random, "a")};
    if (random() % 2 == 0) {
        noise::Warp warp{random_octaves(random, 2, 0.5)};
        terms.push_back({"b", {"a"}, warp});
    }
    if (random() % 2 == 0) {
        const std::string before = terms.back().name;
        terms.push_back(random_leaf(random, "c"));
        noise::ReliefTerm pair{"d", {before, "c"}, random_pairing(random)};
        if (std::holds_alternative<noise::Blend>(pair.node) && random() % 2 == 0) pair.of.push_back("a");
        terms.push_back(pair);
    }
    if (random() % 3 == 0) terms.push_back({"h", {terms.back().name}, random_profile(random)});
    return terms;
}

// Of height fields: a relief as above, perhaps put in place, filled and carved. Gullies of many octaves are dear to
// trace and to judge.
inline std::vector<noise::ReliefTerm> random_landform(Random& random, unsigned most_gullies = 4) {
    std::vector<noise::ReliefTerm> terms = random_relief(random);
    const auto add = [&](std::string name, noise::ReliefNode node) {
        const std::string before = terms.back().name;
        terms.push_back({std::move(name), {before}, std::move(node)});
    };
    if (random() % 2 == 0) {
        const std::string before = terms.back().name;
        terms.push_back({"i", {}, random_place(random)});
        terms.push_back({"j", {before, "i"}, random_pairing(random)});
    }
    if (random() % 2 == 0) {
        add("e", noise::Envelope{.x = uniform(random, -5.0, 5.0),
                                 .z = uniform(random, -5.0, 5.0),
                                 .x_size = uniform(random, 2.0, 9.0),
                                 .z_size = uniform(random, 2.0, 9.0),
                                 .least = uniform(random, 0.0, 0.9),
                                 .lift = uniform(random, -0.5, 0.5)});
    }
    if (random() % 2 == 0) add("f", noise::Fill{uniform(random, -0.1, 0.3), log_uniform(random, 0.02, 0.3)});
    if (random() % 2 == 0 || terms.size() < 3) {
        noise::Gullies gullies;
        gullies.parameters.octaves = 1 + static_cast<int>(random() % most_gullies);
        gullies.parameters.amplitude = uniform(random, 0.05, 0.25);
        gullies.parameters.seed = random() >> 1;
        gullies.size = log_uniform(random, 0.3, 2.0);
        gullies.bands = uniform(random, 0.6, 1.5);
        gullies.branching = random() % 3 == 0 ? uniform(random, 0.0, 1.0) : 1.0;
        add("g", gullies);
        if (random() % 2 == 0) terms.back().of.push_back("a");  // which guides them
    }
    return terms;
}

inline scene::Surface random_composed_surface(Random& random) {
    scene::Surface surface = random_surface(random);
    surface.relief = random_relief(random);
    if (solid::row_of(surface.kind).has_bound) {
        const noise::Certificate found = noise::Relief(surface.relief, 3).certificate();
        surface.shape<solid::LevelSet>().threshold =
            0.5 * (found.low + found.high) + uniform(random, -0.1, 0.1) * (found.high - found.low);
    }
    return surface;
}

// f of a composed surface along a ray, with a distance over which it keeps its sign.
class ComposedField {
  public:
    explicit ComposedField(const scene::Surface& surface, double time = 0.0)
        : drifted_{time * surface.drift.x, time * surface.drift.y, time * surface.drift.z},
          shape_(oracle::shape_of(surface)),
          bare_(bare(surface)),
          relief_(surface.relief, solid::row_of(surface.kind).dimensions == 2),
          base_slope_(shape_.kind == oracle::Kind::isosurface ? 0.0 : 1.0),
          slope_(relief_.slope() + base_slope_) {}

    oracle::Probe probe(const oracle::Vec& p, const oracle::Vec& /*direction*/) const {
        const oracle::Vec at{p[0] - drifted_[0], p[1] - drifted_[1], p[2] - drifted_[2]};
        const double base = bare_.base(p), f = base - relief_.value(at);
        const oracle::ReliefOracle::Rough rough = relief_.rough(at);
        const double outside = base - rough.high, inside = rough.low - base;
        return {f, std::max(std::abs(f) / slope_, std::max(outside, inside) / (base_slope_ + rough.slope))};
    }
    const oracle::Shape& shape() const { return shape_; }

  private:
    static oracle::FieldOracle bare(const scene::Surface& surface) {
        oracle::Shape shape = oracle::shape_of(surface);
        shape.octaves = 0;
        return oracle::FieldOracle(shape);
    }

    oracle::Vec drifted_;
    oracle::Shape shape_;
    oracle::FieldOracle bare_;
    oracle::ReliefOracle relief_;
    double base_slope_, slope_;
};

// times: of each ray.
inline Judgement judge_composed(const scene::Surface& surface, std::span<const trace::Ray> rays,
                                std::span<const trace::Hit> hits, std::span<const double> times) {
    return judge_by([&](double time) { return ComposedField(surface, time); }, rays, hits, times);
}

}  // namespace strata::trace_test
