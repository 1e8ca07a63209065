// Numbers for machines: JSON lines on stdout, floating point with 17 significant digits, never NaN.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "src/estimate/estimator.h"
#include "src/filter/bspline.h"
#include "src/filter/bspline_paper.h"
#include "src/filter/bspline_table.h"
#include "src/sample/shutter.h"
#include "src/scene/key_text.h"
#include "src/scene/typed_number.h"
#include "src/scene/validate.h"
#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"
#include "tools/cli/scene_argument.h"
#include "tools/cli/shared_options.h"
#include "tools/cli/standard_output.h"
#include "tools/cli/stream_input.h"

namespace strata::tools::probe {

namespace {

std::string number(double x) { return std::isfinite(x) ? fmt::format("{:.17g}", x) : "null"; }

std::string vector(const glm::dvec3& v) { return fmt::format("[{},{},{}]", number(v.x), number(v.y), number(v.z)); }

// What is wrong with a line of stdin.
struct BadLine {
    std::string reason;
};

// The finite numbers of a line, or nothing when it holds anything else.
std::optional<std::vector<double>> numbers_of(const std::string& line) {
    std::istringstream words(line);
    std::vector<double> numbers;
    for (std::string word; words >> word;) {
        const auto number = scene::typed_number(word);
        if (!number) return std::nullopt;
        numbers.push_back(*number);
    }
    return numbers;
}

// Calls use(numbers) for each line of stdin that holds `least` to `most` finite numbers, and sends its answer off.
// Other lines, but for empty ones, are errors, as is one that `use` throws BadLine for.
template <class Use>
void each_line(std::size_t least, std::size_t most, const char* allowed, const Use& use) {
    if (cli::standard_input_is_read()) {
        throw cli::UsageError(
            "-: the scene came from standard input, where the points are to come from; allowed: a file");
    }
    std::string line;
    for (std::size_t row = 1; std::getline(std::cin, line); ++row) {
        const auto numbers = numbers_of(line);
        if (numbers && numbers->empty()) continue;
        try {
            if (!numbers || numbers->size() < least || numbers->size() > most) throw BadLine{allowed};
            use(*numbers);
        } catch (const BadLine& bad) {
            throw cli::UsageError(fmt::format("stdin:{}: '{}', allowed: {}", row, scene::excerpt(line), bad.reason));
        }
        if (!cli::flush_out()) return;
    }
    if (std::ferror(stdin) != 0) throw std::runtime_error("cannot read standard input");
}

// Beyond 2^50 cells of the finest octave, double cannot tell positions in a cell (scene/validate.h).
void check_within_reach(const trace::Field& field, double distance) {
    double finest = 0.0;
    for (const noise::Octave& octave : field.octaves()) finest = std::max(finest, octave.frequency);
    if (finest * distance <= scene::kMostCells) return;
    throw BadLine{
        fmt::format("within {:.3g} surface units of surface.origin, where double tells the finest octave's cells apart",
                    scene::kMostCells / finest)};
}

// Where a spinning surface stands at a time given by the user.
glm::dmat3 orientation_at(const trace::Placement& placement, double t) {
    glm::dmat3 orientation = placement.orientation(t);
    if (std::isfinite(orientation[0][0])) return orientation;
    throw BadLine{"a time at which the surface's turns can be counted in double"};
}

scene::Scene surface_scene(const cli::SceneArgument& argument, const char* what) {
    scene::Scene scene = argument.load().scene;
    if (scene.image != scene::ImageKind::surface) {
        throw cli::UsageError(
            fmt::format("probe {}: this scene has no surface (its key image is not \"surface\")", what));
    }
    return scene;
}

double mid_shutter(const scene::Scene& scene) { return estimate::estimator_settings(scene).shutter.middle_s(); }

void probe_field(const cli::SceneArgument& argument) {
    const scene::Scene scene = surface_scene(argument, "field");
    const trace::Field field(scene.surface);
    const trace::Placement placement(scene.surface);
    each_line(3, 4, "x y z [t], world units and seconds", [&](const std::vector<double>& in) {
        const double t = in.size() > 3 ? in[3] : mid_shutter(scene);
        const glm::dmat3 orientation = orientation_at(placement, t);
        const glm::dvec3 x = placement.point_to_local(orientation, {in[0], in[1], in[2]});
        const glm::dvec3 shift = field.noise_shift(t);
        check_within_reach(field, glm::length(x) + glm::length(shift));
        std::string octaves;
        for (std::size_t k = 0; k < field.octaves().size(); ++k) {
            octaves += fmt::format("{}{}", k ? "," : "", number(field.octave(k, x, shift)));
        }
        cli::print_out(fmt::format("{{\"f\":{},\"gradient\":{},\"octaves\":[{}]}}\n", number(field.value(x, shift)),
                                   vector(orientation * field.gradient(x, shift) / placement.scale()), octaves));
    });
}

// ray: `world` in the surface's coordinates.
void print_ray(const integrate::SurfaceImage& image, const trace::Ray& world, const trace::Ray& ray, double t) {
    const glm::dmat3 orientation = orientation_at(image.placement(), t);
    trace::Hit hit;
    trace::TraceCounters counters;
    image.trace({&ray, 1}, {&hit, 1}, counters);
    std::string position = "null", normal = "null", distance = "null";
    if (hit.state == trace::HitState::hit) {
        const glm::dvec3 x = ray.origin + hit.s * ray.direction;
        glm::vec3 n;
        image.normals({&hit, 1}, {&x, 1}, {&ray.noise_shift, 1}, {&n, 1}, counters);
        distance = number(hit.s * image.placement().scale());
        position = vector(image.placement().point_to_world(orientation, x));
        normal = vector(orientation * glm::dvec3(n));
    }
    const bool is_hit = hit.state == trace::HitState::hit;
    const char* verdict = hit.state == trace::HitState::unresolved ? "null" : is_hit ? "true" : "false";
    cli::print_out(
        fmt::format("{{\"origin\":{},\"direction\":{},\"hit\":{},\"t\":{},\"position\":{},\"normal\":{},\"steps\":{},"
                    "\"noise_evaluations\":{}}}\n",
                    vector(world.origin), vector(world.direction), verdict, distance, position, normal, hit.steps,
                    hit.noise_evaluations));
}

struct RayRequest {
    cli::SceneArgument scene;
    std::string pixel, sample;
    integrate::Tracer tracer = integrate::Tracer::fast;
};

// The direction times a power of two, so that no square overflows or vanishes.
glm::dvec3 near_unit_length(const glm::dvec3& direction) {
    const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    if (largest == 0.0) throw BadLine{"ox oy oz dx dy dz [t], a direction other than zero"};
    const int exponent = std::ilogb(largest);
    return {std::scalbn(direction.x, -exponent), std::scalbn(direction.y, -exponent),
            std::scalbn(direction.z, -exponent)};
}

void probe_pixel_ray(const RayRequest& request, const scene::Scene& scene, const integrate::SurfaceImage& image) {
    const glm::ivec2 pixel = cli::parse_pixel(request.pixel, scene.film);
    double u = 0.0, v = 0.0, t = mid_shutter(scene);
    if (!request.sample.empty()) {
        const auto samples = estimate::Estimator(estimate::estimator_settings(scene)).probe_samples(pixel.x, pixel.y);
        const int last = static_cast<int>(samples.size()) - 1;
        const int index = cli::parse_integer("--sample", request.sample, 0, last);
        const estimate::ProbeSample& chosen = samples[static_cast<std::size_t>(index)];
        u = chosen.u;
        v = chosen.v;
        t = chosen.time_s;
    }
    u += pixel.x + 0.5;
    v += pixel.y + 0.5;
    print_ray(image, image.camera_ray(u, v, t), image.local_camera_ray(u, v, t), t);
}

void probe_ray(const RayRequest& request) {
    const scene::Scene scene = surface_scene(request.scene, "ray");
    const integrate::SurfaceImage image(scene, request.tracer);
    if (!request.pixel.empty()) return probe_pixel_ray(request, scene, image);
    if (!request.sample.empty()) throw cli::UsageError("--sample: allowed: with --pixel only");
    each_line(6, 7, "ox oy oz dx dy dz [t], a direction other than zero", [&](const std::vector<double>& in) {
        const glm::dvec3 origin(in[0], in[1], in[2]);
        const double t = in.size() > 6 ? in[6] : mid_shutter(scene);
        const double distance = glm::length(origin - scene.surface.origin) + scene.camera.far;
        check_within_reach(image.field(),
                           distance / image.placement().scale() + glm::length(image.field().noise_shift(t)));
        const glm::dvec3 direction = near_unit_length({in[3], in[4], in[5]});
        const trace::Ray world = image.world_ray(origin, direction, t);
        print_ray(image, world, image.to_local(orientation_at(image.placement(), t), world, t), t);
    });
}

// The bulk table takes a folded probability, its sign tells the half. Below its floor the exact inverse stands in, as
// it does behind the table, but from y itself: float ends at 1e-45.
double bulk_x(const filter::BsplineTable& table, int m, double y, double exact_x) {
    const double q = y <= 0.5 ? -y : 1.0 - y;
    const bool in_table = std::abs(q) >= static_cast<double>(table.table_floor());
    const float x = in_table ? table.centred(static_cast<float>(q)) : static_cast<float>(exact_x - 0.5 * m);
    return static_cast<double>(x) + 0.5 * m;
}

void probe_bspline(int m) {
    constexpr int kMostPaperOrder = 20;
    const filter::BsplineTable table(m);
    each_line(1, 1, "one y in [0,1]", [&](const std::vector<double>& in) {
        const double y = in[0];
        if (!(y >= 0.0 && y <= 1.0)) throw BadLine{"one y in [0,1]"};
        const filter::Inversion exact = filter::bspline_invert(m, y);
        std::string paper_x = "null", paper_iterations = "null";
        if (m <= kMostPaperOrder) {
            const auto paper = filter::paper::inverse_cdf(m, y);
            if (paper.converged) {
                paper_x = number(paper.x);
                paper_iterations = fmt::format("{}", paper.iterations);
            }
        }
        cli::print_out(
            fmt::format("{{\"y\":{},\"x\":{},\"cdf\":{},\"pdf\":{},\"iterations\":{},\"bulk_x\":{},\"paper_x\":{},"
                        "\"paper_iterations\":{}}}\n",
                        number(y), number(exact.x), number(filter::bspline_cdf(m, exact.x)),
                        number(filter::bspline_pdf(m, exact.x)), exact.iterations, number(bulk_x(table, m, y, exact.x)),
                        paper_x, paper_iterations));
    });
}

void probe_samples(const cli::SceneArgument& argument, const std::string& pixel_text) {
    const scene::Scene scene = argument.load().scene;
    const glm::ivec2 pixel = cli::parse_pixel(pixel_text, scene.film);
    for (const auto& s : estimate::Estimator(estimate::estimator_settings(scene)).probe_samples(pixel.x, pixel.y)) {
        cli::print_out(fmt::format("{{\"u\":{},\"v\":{},\"time\":{},\"weight\":{}}}\n", number(s.u), number(s.v),
                                   number(s.time_s), number(s.weight)));
    }
}

}  // namespace

void add_command(cli::Command& program) {
    cli::Command* probe =
        program.add_subcommand("probe", "Numbers as JSON lines: the field, rays, the filter, the samples");
    probe->require_subcommand();

    cli::Command* field = probe->add_subcommand(
        "field",
        "Reads `x y z [t]` lines; prints f, its gradient and each octave's contribution: f = base - sum of octaves");
    auto field_scene = std::make_shared<cli::SceneArgument>();
    field_scene->add_to(*field);
    field->footer(
        "f is in surface units, in double from the reference path, > 0 outside, before the intersection with a "
        "bounding\n"
        "ball or box. The gradient is that of f by world position. Without t: the middle of the frame's shutter.");
    field->action([field_scene] { return probe_field(*field_scene); });

    cli::Command* ray =
        probe->add_subcommand("ray", "Traces rays of the camera, or `ox oy oz dx dy dz [t]` lines of stdin");
    auto ray_request = std::make_shared<RayRequest>();
    ray_request->scene.add_to(*ray);
    ray->add_option("--pixel", ray_request->pixel, "x,y", "The ray through a pixel's centre at mid-shutter");
    ray->add_option("--sample", ray_request->sample, "I",
                    "Through this sample of the pixel, counted as `probe samples` does");
    cli::add_tracer(*ray, ray_request->tracer);
    cli::add_simd(*ray);
    ray->footer(
        "Distances and positions are the world's; direction and normal have unit length. hit is null for a ray that "
        "was\n"
        "not settled within the step limit. noise_evaluations are those of the ray, without the normal's.");
    ray->action([ray_request] { return probe_ray(*ray_request); });

    cli::Command* bspline =
        probe->add_subcommand("bspline", "Reads a y in [0,1] a line; inverts the B-spline's distribution");
    auto order = std::make_shared<int>(4);
    bspline->add_option("-m,--order", *order, filter::kMinOrder, filter::kMaxOrder, "M",
                        "Order of the B-spline, 1 to 100");
    bspline->footer(
        "x in [0,m]; bulk_x is the renderer's float table; paper_* is plain Newton iteration on the plain recursion, "
        "null\n"
        "for m > 20 and where it does not converge within 1000 iterations.");
    bspline->action([order] { probe_bspline(*order); });

    cli::Command* samples = probe->add_subcommand("samples", "Prints every sample with a weight in a pixel");
    auto samples_scene = std::make_shared<cli::SceneArgument>();
    auto pixel = std::make_shared<std::string>();
    samples_scene->add_to(*samples);
    samples->add_option("--pixel", *pixel, "x,y", "The pixel")->required();
    samples->footer("u right and v down in pixels from the pixel's centre, time in seconds; the weights sum to 1.");
    samples->action([samples_scene, pixel] { return probe_samples(*samples_scene, *pixel); });
}

}  // namespace strata::tools::probe
