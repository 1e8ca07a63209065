// Numbers for machines: JSON lines on stdout, floating point with 17 significant digits, never NaN.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <sstream>

#include "src/filter/bspline.h"
#include "src/filter/bspline_paper.h"
#include "src/filter/bspline_table.h"
#include "src/render/estimator.h"
#include "src/sample/shutter.h"
#include "tools/commands.h"
#include "tools/errors.h"
#include "tools/scene_argument.h"

namespace strata::tools {

namespace {

std::string number(double x) { return std::isfinite(x) ? fmt::format("{:.17g}", x) : "null"; }

std::string vector(const glm::dvec3& v) { return fmt::format("[{},{},{}]", number(v.x), number(v.y), number(v.z)); }

// Calls use(numbers) for each line of stdin that holds `least` to `most` finite numbers; other lines, but for empty
// ones, are errors.
template <class Use>
void each_line(std::size_t least, std::size_t most, const char* allowed, const Use& use) {
    std::string line;
    for (std::size_t row = 1; std::getline(std::cin, line); ++row) {
        std::istringstream words(line);
        std::vector<double> numbers;
        bool valid = true;
        for (std::string word; words >> word;) {
            char* end = nullptr;
            numbers.push_back(std::strtod(word.c_str(), &end));
            valid = valid && *end == '\0' && std::isfinite(numbers.back());
        }
        if (numbers.empty() && valid) continue;
        if (!valid || numbers.size() < least || numbers.size() > most) {
            throw UsageError(fmt::format("stdin:{}: '{}', allowed: {}", row, line, allowed));
        }
        use(numbers);
    }
}

scene::Scene surface_scene(const SceneArgument& argument, const char* what) {
    scene::Scene scene = argument.load().scene;
    if (scene.image != scene::ImageKind::surface) {
        throw UsageError(fmt::format("probe {}: this scene has no surface (its key image is not \"surface\")", what));
    }
    return scene;
}

double mid_shutter(const scene::Scene& scene) { return render::estimator_settings(scene).shutter.middle_s(); }

void probe_field(const SceneArgument& argument) {
    const scene::Scene scene = surface_scene(argument, "field");
    const trace::Field field(scene.surface);
    const trace::Placement placement(scene.surface);
    each_line(3, 4, "x y z [t], world units and seconds", [&](const std::vector<double>& in) {
        const glm::dmat3 orientation = placement.orientation(in.size() > 3 ? in[3] : mid_shutter(scene));
        const glm::dvec3 x = placement.point_to_local(orientation, {in[0], in[1], in[2]});
        std::string octaves;
        for (std::size_t k = 0; k < field.octaves().size(); ++k) {
            octaves += (k ? "," : "") + number(field.octave(k, x));
        }
        fmt::print("{{\"f\":{},\"gradient\":{},\"octaves\":[{}]}}\n", number(field.value(x)),
                   vector(orientation * field.gradient(x) / placement.scale()), octaves);
    });
}

void print_ray(const render::SurfaceImage& image, const trace::Ray& world, double t) {
    const glm::dmat3 orientation = image.placement().orientation(t);
    const trace::Ray ray = image.placement().to_local(orientation, world);
    trace::Hit hit;
    trace::TraceCounters counters;
    image.trace({&ray, 1}, {&hit, 1}, counters);
    std::string position = "null", normal = "null", distance = "null";
    if (hit.state == trace::HitState::hit) {
        const glm::dvec3 x = ray.origin + hit.s * ray.direction;
        glm::vec3 n;
        image.normals({&hit, 1}, {&x, 1}, {&n, 1}, counters);
        distance = number(hit.s * image.placement().scale());
        position = vector(image.placement().point_to_world(orientation, x));
        normal = vector(orientation * glm::dvec3(n));
    }
    const bool is_hit = hit.state == trace::HitState::hit;
    const char* verdict = hit.state == trace::HitState::unresolved ? "null" : is_hit ? "true" : "false";
    fmt::print(
        "{{\"origin\":{},\"direction\":{},\"hit\":{},\"t\":{},\"position\":{},\"normal\":{},\"steps\":{},"
        "\"noise_evaluations\":{}}}\n",
        vector(world.origin), vector(world.direction), verdict, distance, position, normal, hit.steps,
        hit.noise_evaluations);
}

struct RayRequest {
    SceneArgument scene;
    std::string pixel, tracer = "fast", simd;
    std::optional<int> sample;
};

void probe_pixel_ray(const RayRequest& request, const scene::Scene& scene, const render::SurfaceImage& image) {
    const glm::ivec2 pixel = parse_pixel(request.pixel, scene.film);
    double u = 0.0, v = 0.0, t = mid_shutter(scene);
    if (request.sample) {
        const auto samples = render::Estimator(render::estimator_settings(scene)).probe_samples(pixel.x, pixel.y);
        const int count = static_cast<int>(samples.size());
        if (*request.sample < 0 || *request.sample >= count) {
            throw UsageError(fmt::format("--sample {}: allowed: 0 to {}", *request.sample, count - 1));
        }
        const render::ProbeSample& chosen = samples[static_cast<std::size_t>(*request.sample)];
        u = chosen.u;
        v = chosen.v;
        t = chosen.time_s;
    }
    print_ray(image, image.camera_ray(pixel.x + 0.5 + u, pixel.y + 0.5 + v), t);
}

void probe_ray(const RayRequest& request) {
    if (!request.simd.empty()) use_simd_target(request.simd);
    const scene::Scene scene = surface_scene(request.scene, "ray");
    const render::SurfaceImage image(scene, parse_tracer(request.tracer));
    if (!request.pixel.empty()) return probe_pixel_ray(request, scene, image);
    if (request.sample) throw UsageError("--sample: allowed: with --pixel only");
    each_line(6, 7, "ox oy oz dx dy dz [t], a direction other than zero", [&](const std::vector<double>& in) {
        const glm::dvec3 direction(in[3], in[4], in[5]);
        if (glm::length(direction) == 0.0) throw UsageError("stdin: direction 0 0 0, allowed: any other");
        print_ray(image, image.world_ray({in[0], in[1], in[2]}, direction), in.size() > 6 ? in[6] : mid_shutter(scene));
    });
}

// The folded probability that the bulk table takes: its sign tells the half.
double bulk_x(const filter::BsplineTable& table, int m, double y) {
    const auto q = static_cast<float>(y <= 0.5 ? -y : 1.0 - y);
    float x = 0.0f;
    table.centred({&q, 1}, {&x, 1});
    return static_cast<double>(x) + 0.5 * m;
}

void probe_bspline(int m) {
    constexpr int kMostPaperOrder = 20;
    const filter::BsplineTable table(m);
    each_line(1, 1, "one y in [0,1]", [&](const std::vector<double>& in) {
        const double y = in[0];
        if (!(y >= 0.0 && y <= 1.0)) throw UsageError(fmt::format("stdin: {}, allowed: y in [0,1]", y));
        const filter::Inversion exact = filter::bspline_invert(m, y);
        std::string paper_x = "null", paper_iterations = "null";
        if (m <= kMostPaperOrder) {
            const auto paper = filter::paper::inverse_cdf(m, y);
            if (paper.converged) {
                paper_x = number(paper.x);
                paper_iterations = fmt::format("{}", paper.iterations);
            }
        }
        fmt::print(
            "{{\"y\":{},\"x\":{},\"cdf\":{},\"pdf\":{},\"iterations\":{},\"bulk_x\":{},\"paper_x\":{},"
            "\"paper_iterations\":{}}}\n",
            number(y), number(exact.x), number(filter::bspline_cdf(m, exact.x)),
            number(filter::bspline_pdf(m, exact.x)), exact.iterations, number(bulk_x(table, m, y)), paper_x,
            paper_iterations);
    });
}

void probe_samples(const SceneArgument& argument, const std::string& pixel_text) {
    const scene::Scene scene = argument.load().scene;
    const glm::ivec2 pixel = parse_pixel(pixel_text, scene.film);
    for (const auto& s : render::Estimator(render::estimator_settings(scene)).probe_samples(pixel.x, pixel.y)) {
        fmt::print("{{\"u\":{},\"v\":{},\"time\":{},\"weight\":{}}}\n", number(s.u), number(s.v), number(s.time_s),
                   number(s.weight));
    }
}

}  // namespace

void add_probe_command(CLI::App& program, int&) {
    CLI::App* probe =
        program.add_subcommand("probe", "Numbers as JSON lines: the field, rays, the filter, the samples");
    probe->require_subcommand(1);

    CLI::App* field = probe->add_subcommand(
        "field",
        "Reads `x y z [t]` lines; prints f, its gradient and each octave's contribution: f = base - sum of octaves");
    auto field_scene = std::make_shared<SceneArgument>();
    field_scene->add_to(*field);
    field->footer(
        "f is in surface units, in double from the reference path, > 0 outside, before the intersection with a "
        "bounding\n"
        "ball or box. The gradient is that of f by world position. Without t: the middle of the frame's shutter.");
    field->callback([field_scene] { probe_field(*field_scene); });

    CLI::App* ray =
        probe->add_subcommand("ray", "Traces rays of the camera, or `ox oy oz dx dy dz [t]` lines of stdin");
    auto ray_request = std::make_shared<RayRequest>();
    ray_request->scene.add_to(*ray);
    ray->add_option("--pixel", ray_request->pixel, "The ray through a pixel's centre at mid-shutter")->type_name("x,y");
    ray->add_option("--sample", ray_request->sample,
                    "Through this sample of the pixel, counted as `probe samples` does")
        ->type_name("I");
    ray->add_option("--tracer", ray_request->tracer, "fast or reference")->capture_default_str()->type_name("NAME");
    ray->add_option("--simd", ray_request->simd, "avx512, avx2, sse4 or scalar")->type_name("TARGET");
    ray->footer(
        "Distances and positions are the world's; direction and normal have unit length. hit is null for a ray that "
        "was\n"
        "not settled within the step limit. noise_evaluations are those of the ray, without the normal's.");
    ray->callback([ray_request] { probe_ray(*ray_request); });

    CLI::App* bspline =
        probe->add_subcommand("bspline", "Reads a y in [0,1] a line; inverts the B-spline's distribution");
    auto order = std::make_shared<int>(4);
    bspline->add_option("-m,--order", *order, "Order of the B-spline")
        ->capture_default_str()
        ->check(CLI::Range(filter::kMinOrder, filter::kMaxOrder));
    bspline->footer(
        "x in [0,m]; bulk_x is the renderer's float table; paper_* is plain Newton iteration on the plain recursion, "
        "null\n"
        "for m > 20 and where it does not converge within 1000 iterations.");
    bspline->callback([order] { probe_bspline(*order); });

    CLI::App* samples = probe->add_subcommand("samples", "Prints every sample with a weight in a pixel");
    auto samples_scene = std::make_shared<SceneArgument>();
    auto pixel = std::make_shared<std::string>();
    samples_scene->add_to(*samples);
    samples->add_option("--pixel", *pixel, "The pixel")->required()->type_name("x,y");
    samples->footer("u right and v down in pixels from the pixel's centre, time in seconds; the weights sum to 1.");
    samples->callback([samples_scene, pixel] { probe_samples(*samples_scene, *pixel); });
}

}  // namespace strata::tools
