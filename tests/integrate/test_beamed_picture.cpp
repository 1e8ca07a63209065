// Pictures whose rays begin where beams ended: each sample's bits are its own, and what its ray hits is what the
// surface's definition says.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "src/integrate/surface_image.h"
#include "tests/support/surfaces.h"
#include "tools/stability/oracles/ray_oracle.h"
#include "tools/stability/oracles/shape_of.h"

using namespace strata;
using namespace strata::integrate;

namespace {

using Random = std::mt19937_64;

constexpr int kWidth = 64, kHeight = 36;
constexpr int kDense = 40;      // samples a pixel and axis
constexpr double kHaze = 40.0;  // surface units

struct Named {
    std::string name;
    scene::Scene scene;
};

// The camera rests, so that rays have beams.
scene::Scene base_scene(solid::Kind kind) {
    scene::Scene scene = support::small_scene(kind, kWidth, kHeight);
    scene.sampling.N = 3;
    scene.surface.octaves = 6;
    scene.surface.shape<solid::LevelSet>().bound_size = {1.5, 1.2, 1.4};
    if (support::is_bounded(scene.surface)) scene.camera.position.z = -5.0;
    return scene;
}

std::vector<Named> scenes() {
    std::vector<Named> all;
    const auto add = [&](const std::string& name, solid::Kind kind) -> scene::Scene& {
        all.push_back({name, base_scene(kind)});
        return all.back().scene;
    };
    for (const solid::KindRow& row : solid::all_solids()) add(std::string(row.name), row.kind);
    add("isosurface in a box", solid::kKind<solid::LevelSet>).surface.shape<solid::LevelSet>().bound =
        solid::LevelSet::Bound::box;
    {
        scene::Scene& s = add("planet that spins", solid::kKind<solid::Sphere>);
        s.surface.spin_deg_per_s = 90.0, s.shutter.open_s = 0.1;
    }
    {
        scene::Scene& s = add("hyperterrain that drifts", solid::kKind<solid::DisplacedPlane>);
        s.surface.drift = {2.0, -0.5, 3.0}, s.shutter.open_s = 0.1;
    }
    {
        scene::Scene& s = add("isosurface that spins, drifts, is scaled and turned", solid::kKind<solid::LevelSet>);
        s.surface.drift = {0.5, 0.3, -0.6}, s.surface.spin_deg_per_s = -120.0, s.shutter.open_s = 0.1;
        s.surface.scale = 1.3, s.surface.rotation_deg = {20.0, -40.0, 70.0}, s.surface.origin = {0.2, -0.1, 0.3};
    }
    {
        // The eye is close to the ground and far from the axis: it moves fast over the land, at a slope to it.
        scene::Scene& s = add("terrain that spins under the eye", solid::kKind<solid::HeightField>);
        s.surface.spin_deg_per_s = 80.0, s.surface.amplitude = 1.5, s.shutter.open_s = 0.2;
        s.camera.position = {6.0, 0.9, 0.0}, s.camera.look_at = {6.2, 0.7, 1.0};
    }
    {
        scene::Scene& s = add("planet whose hills spin past the eye", solid::kKind<solid::Sphere>);
        s.surface.spin_deg_per_s = 80.0, s.surface.amplitude = 0.6, s.shutter.open_s = 0.4;
        s.surface.frequency = 1.0;
        s.camera.position = {2.3, 0.0, 0.0}, s.camera.look_at = {2.2, 0.1, -1.0};
    }
    // With many samples a pixel, cells are narrow enough for windows.
    for (std::size_t i = 0, count = all.size(); i < count; ++i) {
        Named& dense = all.emplace_back(all[i]);
        dense.name += ", in windows";
        dense.scene.sampling.N = kDense;
    }
    return all;
}

// Radiance tells distance: the land is black, the haze and the sky are white.
scene::Scene telling_distance(scene::Scene scene) {
    scene.material.low = scene.material.high = scene.material.steep = glm::dvec3(0.0);
    scene.sky.zenith = scene.sky.horizon = glm::dvec3(1.0);
    scene.sky.haze_distance = kHaze;
    scene.sun.shadows = false;
    return scene;
}

struct Samples {
    std::vector<double> u, v, t;
    std::size_t size() const { return u.size(); }
    SampleBatch batch(std::size_t first, std::size_t count) const {
        return {std::span(u).subspan(first, count), std::span(v).subspan(first, count),
                std::span(t).subspan(first, count)};
    }
    void push(double at_u, double at_v, double at_t) { u.push_back(at_u), v.push_back(at_v), t.push_back(at_t); }
};

// Spread over the frame and beyond its edges, and a dense patch whose cells are full.
Samples random_samples(Random& random, std::size_t count, const scene::TimeSpan& shutter) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double patch_u = 0.8 * kWidth * unit(random), patch_v = 0.8 * kHeight * unit(random);
    Samples samples;
    for (std::size_t i = 0; i < count; ++i) {
        const double t = std::lerp(shutter.first, shutter.last, unit(random));
        if (i % 3 == 0) {
            samples.push(patch_u + 3.0 * unit(random), patch_v + 3.0 * unit(random), t);
        } else {
            samples.push((kWidth + 8.0) * unit(random) - 4.0, (kHeight + 8.0) * unit(random) - 4.0, t);
        }
    }
    return samples;
}

std::vector<glm::vec3> evaluate(const SurfaceImage& image, const Samples& samples, Counters& work) {
    std::vector<glm::vec3> radiance(samples.size());
    image.evaluate(samples.batch(0, samples.size()), radiance, work);
    return radiance;
}

bool same_bits(const glm::vec3& a, const glm::vec3& b) { return std::memcmp(&a, &b, sizeof(a)) == 0; }

// Hit distance in surface units, or none.
struct Seen {
    bool hit = false;
    double s = 0.0;
};

Seen seen_by(const glm::vec3& radiance) {
    if (radiance.x >= 1.0f) return {};
    return {true, -kHaze * std::log1p(-static_cast<double>(radiance.x))};
}

// Of a distance told by a float in [0, 1].
double decoding_error(double s) { return 4.0 * 0x1p-24 * kHaze * std::exp(s / kHaze); }

}  // namespace

TEST_CASE("a sample has the same bits alone, in a batch, in a shuffled batch, and however batches are split") {
    Random random(61);
    for (const auto& item : scenes()) {
        const std::string& name = item.name;
        const scene::Scene& scene = item.scene;
        CAPTURE(name);
        const SurfaceImage image(scene, Tracer::fast);
        const Samples samples = random_samples(random, 1500, scene::open_shutter(scene));
        const std::size_t count = samples.size();
        Counters work, alone_work;
        const std::vector<glm::vec3> whole = evaluate(image, samples, work);
        CHECK(work.hits > count / 10);
        CHECK(work.phases[static_cast<std::size_t>(Phase::beams)].steps > 0);

        int alone_differs = 0, shuffled_differs = 0, split_differs = 0;
        for (std::size_t i = 0; i < count; i += 5) {
            glm::vec3 alone;
            image.evaluate(samples.batch(i, 1), std::span(&alone, 1), alone_work);
            alone_differs += !same_bits(alone, whole[i]);
        }
        std::vector<std::size_t> order(count);
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::shuffle(order.begin(), order.end(), random);
        Samples shuffled;
        for (const std::size_t i : order) shuffled.push(samples.u[i], samples.v[i], samples.t[i]);
        Counters shuffled_work, split_work;
        const std::vector<glm::vec3> again = evaluate(image, shuffled, shuffled_work);
        for (std::size_t i = 0; i < count; ++i) shuffled_differs += !same_bits(again[i], whole[order[i]]);
        for (std::size_t begin = 0, size = 1; begin < count; begin += size, size = 1 + random() % 300) {
            size = std::min(size, count - begin);
            std::vector<glm::vec3> part(size);
            image.evaluate(shuffled.batch(begin, size), part, split_work);
            for (std::size_t i = 0; i < size; ++i) split_differs += !same_bits(part[i], again[begin + i]);
        }
        CHECK(alone_differs == 0);
        CHECK(shuffled_differs == 0);
        CHECK(split_differs == 0);
        CHECK(shuffled_work.noise_evaluations == work.noise_evaluations);
        CHECK(shuffled_work.steps == work.steps);
        CHECK(split_work.hits == work.hits);
    }
}

TEST_CASE("the distances in a beamed picture are first hits within the tolerance, by the surface's definition") {
    Random random(62);
    std::uint64_t windows = 0;
    for (const auto& item : scenes()) {
        const std::string& name = item.name;
        const scene::Scene& still = item.scene;
        CAPTURE(name);
        const scene::Scene scene = telling_distance(still);
        const SurfaceImage image(scene, Tracer::fast);
        const Samples samples = random_samples(random, 500, scene::open_shutter(scene));
        Counters work;
        const std::vector<glm::vec3> radiance = evaluate(image, samples, work);
        int missed = 0, unfounded = 0, undecided = 0;
        double thickest = 0.0;
        std::size_t hits = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const double t = samples.t[i];
            const trace::Ray ray = image.local_camera_ray(samples.u[i], samples.v[i], t);
            const oracle::FieldOracle field(oracle::shape_of(scene.surface, t));
            const Seen seen = seen_by(radiance[i]);
            hits += seen.hit;
            const auto delta = [&](double s) { return ray.delta0 + ray.delta_slope * s + decoding_error(s); };
            const oracle::Verdict verdict = oracle::judge_ray(field, {ray.origin.x, ray.origin.y, ray.origin.z},
                                                              {ray.direction.x, ray.direction.y, ray.direction.z},
                                                              ray.limit, delta, {seen.hit, seen.s}, 200'000);
            missed += verdict.missed;
            unfounded += verdict.unfounded;
            undecided += verdict.undecided || verdict.cut_short;
            thickest = std::max(thickest, verdict.thickest);
        }
        MESSAGE(name << ": " << hits << " hits, thickest stretch passed over " << thickest << " delta (bound 1), "
                     << undecided << " undecided");
        CHECK(hits == work.hits);
        windows += work.phases[static_cast<std::size_t>(Phase::windows)].steps;
        CHECK(missed == 0);
        CHECK(unfounded == 0);
        CHECK(undecided * 100 <= static_cast<int>(samples.size()));
        CHECK(hits > samples.size() / 10);
    }
    MESSAGE(windows << " windows");
    CHECK(windows > 1000);
}

TEST_CASE("the reference tracer sees what beams see: hits and misses, and distances within both tolerances") {
    Random random(63);
    for (const auto& item : scenes()) {
        const std::string& name = item.name;
        const scene::Scene& still = item.scene;
        CAPTURE(name);
        scene::Scene scene = telling_distance(still);
        scene.surface.octaves = 3;  // its steps shrink with the sum of slopes
        const SurfaceImage fast(scene, Tracer::fast), reference(scene, Tracer::reference);
        const Samples samples = random_samples(random, 400, scene::open_shutter(scene));
        Counters fast_work, reference_work;
        const std::vector<glm::vec3> found = evaluate(fast, samples, fast_work);
        const std::vector<glm::vec3> expected = evaluate(reference, samples, reference_work);
        int apart = 0, of_both = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const Seen a = seen_by(found[i]), b = seen_by(expected[i]);
            if (!a.hit && !b.hit) continue;
            ++of_both;
            const trace::Ray ray = fast.camera_ray(samples.u[i], samples.v[i], samples.t[i]);
            const double delta = 2.0 * ray.delta_slope * std::max(a.s, b.s) + decoding_error(std::max(a.s, b.s));
            apart += a.hit != b.hit || std::abs(a.s - b.s) > delta;
        }
        MESSAGE(name << ": " << apart << " of " << of_both << " rays apart");
        // Where a ray grazes, tracers within their tolerance may take different first hits.
        CHECK(apart * 40 <= of_both);
        CHECK(of_both > 40);
    }
}
