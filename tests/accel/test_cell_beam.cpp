// The beam of a screen cell holds the cell's rays, at all of its times, where there can be a surface.
#include "src/accel/cell_beam.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "src/trace/beam_tracer.h"
#include "tests/support/surfaces.h"
#include "tests/trace/ray_families.h"

using namespace strata;
using namespace strata::accel;
using namespace strata::trace_test;

namespace {

// The camera flies, looks about and zooms, a little or much.
void add_keys(Random& random, scene::Camera& camera) {
    const double size = log_uniform(random, 1e-3, 1.0) * glm::distance(camera.position, camera.look_at);
    camera.interpolation = random() % 2 == 0 ? scene::Interpolation::smooth : scene::Interpolation::linear;
    for (const double time_s : {-0.5, 1.0, 2.5, 4.5}) {
        camera.keys.push_back({.time_s = time_s,
                               .position = camera.position + uniform(random, 0.0, 0.4) * size * unit_vector(random),
                               .look_at = camera.look_at + uniform(random, 0.0, 0.4) * size * unit_vector(random),
                               .fov_deg = camera.fov_deg * uniform(random, 0.8, 1.0)});
    }
}

// A sum of 1: spinning, 2: drifting, 4: the camera moving.
scene::Scene random_scene(Random& random, solid::Kind kind, int motion) {
    scene::Scene scene;
    scene.film = {.width = 1 + static_cast<int>(random() % 2000), .height = 1 + static_cast<int>(random() % 2000)};
    scene::Surface& s = scene.surface = surface_of(kind);
    s.shape<solid::LevelSet>().bound = random() % 2 == 0 ? solid::LevelSet::Bound::ball : solid::LevelSet::Bound::box;
    s.octaves = 1 + static_cast<int>(random() % 8);
    s.amplitude = log_uniform(random, 1e-2, 2.0);
    s.shape<solid::Sphere>().radius = log_uniform(random, 0.1, 1e3);
    s.scale = random() % 2 == 0 ? 1.0 : log_uniform(random, 1e-3, 1e3);
    if (random() % 2 == 0) {
        s.origin = log_uniform(random, 0.1, 1e4) * unit_vector(random);
        s.rotation_deg = 180.0 * unit_vector(random);
    }
    if ((motion & 1) != 0) {
        s.spin_axis = unit_vector(random);
        s.spin_deg_per_s = log_uniform(random, 1e-2, 720.0) * (random() % 2 == 0 ? 1.0 : -1.0);
    }
    if ((motion & 2) != 0) s.drift = log_uniform(random, 1e-3, 10.0) * unit_vector(random);
    const solid::Extent extent = trace::Field(s).extent();
    const double size = s.scale * (std::isfinite(extent.ball) ? extent.ball : 4.0);
    const glm::dvec3 away = unit_vector(random);
    scene.camera.position = s.origin + log_uniform(random, 0.3, 20.0) * size * away;
    scene.camera.look_at = s.origin + uniform(random, 0.0, 1.2) * size * unit_vector(random) + 1e-3 * size * away;
    scene.camera.up = unit_vector(random);
    scene.camera.fov_deg = random() % 3 == 0 ? uniform(random, 100.0, 175.0) : log_uniform(random, 0.5, 100.0);
    scene.camera.far = log_uniform(random, 2.0, 100.0) * size;
    scene.shutter = {.fps = 25.0, .open_s = 4.0, .frame = 0};
    if ((motion & 4) != 0) add_keys(random, scene.camera);
    return scene;
}

// Off the frame's middle, and out of it by some.
ScreenCell random_cell(Random& random, const scene::Film& film) {
    ScreenCell cell;
    cell.side = std::exp2(std::round(uniform(random, -6.0, 8.0)));
    cell.x = cell.side * std::floor(uniform(random, -0.1, 1.1) * film.width / cell.side);
    cell.y = cell.side * std::floor(uniform(random, -0.1, 1.1) * film.height / cell.side);
    const double middle = uniform(random, 0.2, 3.8), half = log_uniform(random, 1e-6, 0.2);
    cell.time = {middle - half, middle + half};
    return cell;
}

// Corners, edges and ends, or anywhere.
double within(Random& random, double first, double length) {
    switch (random() % 4) {
        case 0:
            return first;
        case 1:
            return std::nextafter(first + length, first);
        default:
            return first + uniform(random, 0.0, 1.0) * length;
    }
}

struct Scenery {
    explicit Scenery(const scene::Scene& s)
        : scene(s), path(s.camera), placement(s.surface), field(s.surface), beams(scene, path, placement, field) {}

    trace::Ray ray(double u, double v, double t) const {
        const trace::Camera camera(path.at(t), scene.film);
        const trace::Ray world{
            .origin = camera.position(), .direction = camera.ray(u, v).direction, .limit = scene.camera.far};
        return placement.to_local(placement.orientation(t), world, field.noise_shift(t));
    }

    // What is solid may be there.
    bool may_be_solid(const glm::dvec3& x) const {
        const oracle::Shape shape = oracle::shape_of(scene.surface);
        if (shape.container == oracle::Container::ball) return glm::length(x) <= shape.container_size[0];
        if (shape.container == oracle::Container::box) {
            for (int a = 0; a < 3; ++a) {
                if (std::abs(x[a]) > shape.container_size[static_cast<std::size_t>(a)]) return false;
            }
            return true;
        }
        // The base exceeds what noise of at most 1.04 each octave takes off.
        double noise = 0.0;
        for (int k = 0; k < scene.surface.octaves; ++k)
            noise += scene.surface.amplitude * std::pow(scene.surface.gain, k);
        return oracle::FieldOracle(shape).base({x.x, x.y, x.z}) <= 1.0363 * noise;
    }

    scene::Scene scene;
    scene::CameraPath path;
    trace::Placement placement;
    trace::Field field;
    CellBeams beams;
};

// How far points of rays are from where the cell's beam says they are, relative to the lengths involved; at most 0 but
// for rounding.
struct Excess {
    double across = -1.0, ahead = -1.0, behind = -1.0, before_start = -1.0, beyond_limit = -1.0, before_origin = -1.0,
           noise = -1.0;
    std::size_t points = 0, beams = 0, none = 0;
    double widest_share = 0.0;  // of the radius that rays reach
};

// Distances along a ray: near its beginning, where it passes what is solid, and up to its limit.
double distance_on(Random& random, const trace::Ray& ray) {
    const double nearest = -glm::dot(ray.origin, ray.direction);
    switch (random() % 5) {
        case 0:
            return 0.0;
        case 1:
            return ray.limit * log_uniform(random, 1e-9, 1.0);
        case 2:
            return ray.limit * uniform(random, 0.0, 1.0);
        default:
            return std::clamp(nearest +
                                  uniform(random, -1.5, 1.5) *
                                      std::sqrt(std::max(0.0, glm::dot(ray.origin, ray.origin) - nearest * nearest)) +
                                  uniform(random, -10.0, 10.0),
                              0.0, ray.limit);
    }
}

void measure(Random& random, const Scenery& scenery, const ScreenCell& cell, Excess& worst) {
    const auto found = scenery.beams.around(cell);
    ++(found ? worst.beams : worst.none);
    if (!found) return;
    const trace::Beam& beam = found->beam;
    REQUIRE(std::abs(glm::length(beam.direction) - 1.0) < 1e-14);
    for (int i = 0; i < 60; ++i) {
        const double t = within(random, cell.time.first, cell.time.last - cell.time.first);
        const trace::Ray ray = scenery.ray(within(random, cell.x, cell.side), within(random, cell.y, cell.side), t);
        const double s = distance_on(random, ray);
        const glm::dvec3 x = ray.origin + s * ray.direction;
        if (!scenery.may_be_solid(x)) continue;
        ++worst.points;
        const glm::dvec3 away = x - beam.origin;
        const double along = glm::dot(away, beam.direction);
        const double across = glm::length(away - along * beam.direction);
        const double radius = beam.radius0 + beam.spread * along;
        const double size = glm::length(beam.origin) + s;
        worst.across = std::max(worst.across, (across - radius) / size);
        worst.ahead = std::max(worst.ahead, (along - (s + found->margins.shift)) / size);
        worst.behind = std::max(worst.behind, (s * found->margins.cosine - found->margins.shift - along) / size);
        worst.before_start = std::max(worst.before_start, (beam.start - along) / size);
        worst.beyond_limit = std::max(worst.beyond_limit, (along - beam.limit) / size);
        worst.before_origin = std::max(worst.before_origin, -along / size);
        worst.noise = std::max(worst.noise, (glm::distance(ray.noise_shift, beam.noise_shift) - beam.noise_radius) /
                                                (1.0 + glm::length(beam.noise_shift)));
        if (radius > 1e-9 * size) worst.widest_share = std::max(worst.widest_share, across / radius);
    }
}

void check_kind(solid::Kind kind, int motion) {
    // Of lengths that are of the order of `size`: some roundings.
    constexpr double kRounding = 1e-14;
    Random random(91 + 8 * static_cast<std::uint64_t>(kind) + static_cast<std::uint64_t>(motion));
    Excess worst;
    for (int trial = 0; trial < 250; ++trial) {
        const Scenery scenery(random_scene(random, kind, motion));
        for (int i = 0; i < 8; ++i) measure(random, scenery, random_cell(random, scenery.scene.film), worst);
    }
    MESSAGE("kind " << static_cast<int>(kind) << ", motion " << motion << ": " << worst.beams << " beams, "
                    << worst.none << " cells without, " << worst.points << " points, at most " << worst.widest_share
                    << " of the radius; before the origin " << worst.before_origin);
    CHECK(worst.across <= kRounding);
    CHECK(worst.ahead <= kRounding);
    CHECK(worst.behind <= kRounding);
    CHECK(worst.before_start <= kRounding);
    CHECK(worst.beyond_limit <= kRounding);
    CHECK(worst.before_origin <= kRounding);
    CHECK(worst.noise <= kRounding);
    CHECK(worst.points > 5000);
    CHECK(worst.beams > worst.none);
    CHECK(worst.widest_share > 0.9);
}

}  // namespace

TEST_CASE("rays through a cell stay in its beam, over surfaces at rest: scaled, turned and far away ones too") {
    for (const solid::Kind kind : support::all_kinds()) check_kind(kind, 0);
}

TEST_CASE("rays through a cell at all of its times stay in its beam, over surfaces that spin") {
    for (const solid::Kind kind : support::all_kinds()) check_kind(kind, 1);
}

TEST_CASE("rays through a cell at all of its times stay in its beam, with noise that drifts, spinning or not") {
    for (const solid::Kind kind : support::all_kinds()) {
        check_kind(kind, 2);
        check_kind(kind, 3);
    }
}

TEST_CASE("rays through a cell at all of its times stay in its beam, of a camera that moves, over all else that may") {
    for (const solid::Kind kind : support::all_kinds()) {
        for (const int motion : {4, 5, 6, 7}) check_kind(kind, motion);
    }
}

namespace {

// A surface with spikes, or a nearly smooth one, that spins past an eye close to it.
scene::Scene spikes(Random& random, solid::Kind kind) {
    scene::Scene scene;
    scene.film = {.width = 64, .height = 36};
    scene.surface = surface_of(kind);
    scene.surface.octaves = 1 + static_cast<int>(random() % 3);
    scene.surface.amplitude = random() % 2 == 0 ? log_uniform(random, 0.5, 2.0) : log_uniform(random, 1e-3, 0.5);
    scene.surface.frequency = log_uniform(random, 0.2, 1.0);
    scene.surface.shape<solid::Sphere>().radius = 4.0;
    scene.surface.shape<solid::LevelSet>().threshold = 0.2 * scene.surface.amplitude;
    scene.surface.shape<solid::LevelSet>().bound_size = glm::dvec3(6.0);
    scene.surface.seed = random() >> 1;
    scene.surface.spin_deg_per_s = 60.0;
    const double height = uniform(random, 0.1, 0.7) * std::max(0.3, scene.surface.amplitude);
    const glm::dvec3 away = uniform(random, 2.0, 5.0) * unit_vector(random);
    scene.camera.position = solid::over(scene.surface.solid(), away, height);
    // Land that goes past, up or down, or anyhow; seen about the way that the eye takes over it.
    const glm::dvec3 axes[] = {glm::dvec3(0.0, 1.0, 0.0), unit_vector(random),
                               glm::normalize(glm::cross(away, glm::dvec3(0.0, 1.0, 0.0)))};
    scene.surface.spin_axis = axes[random() % 3];
    const glm::dvec3 way = glm::normalize(glm::cross(scene.camera.position, scene.surface.spin_axis));
    scene.camera.look_at =
        scene.camera.position + (random() % 2 == 0 ? way : -way) + uniform(random, 0.0, 0.7) * unit_vector(random);
    scene.camera.far = 50.0;
    return scene;
}

}  // namespace

TEST_CASE("every ray of a cell is free up to where the cell's beam ended, where land spins past the eye") {
    Random random(96);
    for (const solid::Kind kind : support::all_kinds()) {
        int passed = 0, rays = 0, inside = 0;
        for (int trial = 0; trial < 1500; ++trial) {
            const Scenery scenery(spikes(random, kind));
            const ScreenCell cell{.x = 4.0 * static_cast<double>(random() % 16),
                                  .y = 4.0 * static_cast<double>(random() % 9),
                                  .side = 4.0,
                                  .time = {0.0, log_uniform(random, 1e-3, 0.3)}};
            const auto found = scenery.beams.around(cell);
            if (!found) continue;
            trace::BeamEnd end;
            trace::TraceCounters counters;
            trace::BeamTracer(scenery.field).trace({&found->beam, 1}, {&end, 1}, counters);
            const double free = std::min(end.s - found->margins.shift, scenery.scene.camera.far);
            if (!(free > 0.0)) continue;
            ++passed;
            const oracle::FieldOracle field(oracle::shape_of(scenery.scene.surface));
            for (int i = 0; i < 12; ++i) {
                const double t = within(random, cell.time.first, cell.time.last);
                const trace::Ray ray =
                    scenery.ray(within(random, cell.x, cell.side), within(random, cell.y, cell.side), t);
                const double s = free * (i < 4 ? 0.0 : uniform(random, 0.0, 1.0));
                const glm::dvec3 x = ray.origin + s * ray.direction;
                ++rays;
                if (!scenery.may_be_solid(x) || field.value({x.x, x.y, x.z}) > 0.0) continue;
                ++inside;
                INFO("seed " << scenery.scene.surface.seed << " octaves " << scenery.scene.surface.octaves
                             << " amplitude " << scenery.scene.surface.amplitude << " eye "
                             << scenery.scene.camera.position.x << ' ' << scenery.scene.camera.position.y << ' '
                             << scenery.scene.camera.position.z << " t " << t << " of " << cell.time.last << " s " << s
                             << " free up to " << free);
                CHECK(inside == 0);
            }
        }
        MESSAGE("kind " << static_cast<int>(kind) << ": " << passed << " beams went on, " << rays << " points");
        CHECK(passed > 100);
    }
}
