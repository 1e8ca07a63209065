#include <fmt/format.h>

#include <cmath>
#include <regex>

#include "tools/bench/peers.h"
#include "tools/cli/process.h"

namespace strata::tools::bench {

namespace {

std::string vector_text(const glm::dvec3& v) { return fmt::format("<{:.17g}, {:.17g}, {:.17g}>", v.x, v.y, v.z); }

// 0.6*(2*n(0.5*x+11,0.5*y+23,0.5*z+37,3)-1) + ...; offsets as no lattice of one octave meets another's.
std::string sum_of_octaves(const scene::Surface& surface) {
    std::string text;
    double amplitude = surface.amplitude, frequency = surface.frequency;
    for (int k = 0; k < surface.octaves; ++k) {
        const auto coordinate = [&](char axis, double step) {
            return fmt::format("{:.17g}*{}+{:.17g}", frequency, axis, std::fmod(step * (k + 1), 1.0) * 100);
        };
        text += fmt::format("{}\n    {:.17g}*(2*n({}, {}, {}, 3)-1)", k == 0 ? "" : " +", amplitude,
                            coordinate('x', 0.7548776662466927), coordinate('y', 0.5698402909980532),
                            coordinate('z', 0.4301597090019468));
        amplitude *= surface.gain;
        frequency *= surface.lacunarity;
    }
    return text;
}

// A box about what the camera sees up to `far`, along +z.
std::string seen_box(const scene::Scene& scene) {
    const double height = 1.01 * 2 * scene.surface.amplitude * 1.04;  // the sum of a halving series, and max |n|
    const double half_width = scene.camera.far * std::tan(glm::radians(0.5 * scene.camera.fov_deg));
    return fmt::format("box {{ {}, {} }}", vector_text({-half_width, -height, -0.5}),
                       vector_text({half_width, height, scene.camera.far}));
}

}  // namespace

std::string povray_scene(const scene::Scene& scene) {
    const glm::dvec3 sun = glm::normalize(scene.sun.direction);
    return fmt::format(
        R"(#version 3.7;
global_settings {{ assumed_gamma 1.0 }}
#declare n = function {{ internal(78) }} // f_noise_generator of functions.inc
camera {{
  perspective location {} right -x*image_width/image_height up y angle {:.17g} look_at {}
}}
light_source {{ {} rgb 2 parallel point_at 0 #if (!Shadows) shadowless #end }}
background {{ rgb <0.4, 0.6, 0.9> }}
isosurface {{
  function {{ y - ({}) }}
  contained_by {{ {} }}
  threshold 0 max_gradient Gradient accuracy 0.001 open
  pigment {{ rgb <0.5, 0.45, 0.35> }} finish {{ ambient 0.2 diffuse 0.6 }}
}}
)",
        vector_text(scene.camera.position), scene.camera.fov_deg, vector_text(scene.camera.look_at),
        vector_text(1000.0 * sun), sum_of_octaves(scene.surface), seen_box(scene));
}

double povray_trace_seconds(const std::string& output) {
    static const std::regex pattern(
        R"(Trace Time:[^)]*\)\s*using\s+\d+\s+thread\(s\)\s+with\s+([0-9.]+)\s+CPU-seconds)");
    std::smatch found;
    if (!std::regex_search(output, found, pattern)) {
        throw cli::ProcessError("povray: its statistics name no trace time:\n" + output);
    }
    return std::stod(found[1].str());
}

}  // namespace strata::tools::bench
