// Layers of ground in a picture: what the stages tell a material of a hit, and what rough ground does with light.
#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

#include "shaders_cpu/rough_lobe.h"
#include "src/integrate/surface_image.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"

using namespace strata;
using namespace strata::integrate;

namespace {

// Level ground under the sun alone.
scene::Scene level_ground(const std::string& layers) {
    scene::Scene scene = scene::read_scene("image = \"surface\"\n" + layers, "here");
    scene.film = {.width = 64, .height = 36};
    scene.sampling.estimator = scene::EstimatorKind::none;
    scene.surface.amplitude = 0.0;
    scene.camera.position = {0.0, 2.0, 0.0};
    scene.camera.look_at = {0.0, 0.0, 3.0};
    scene.camera.far = 1e4;
    scene.sky.zenith = scene.sky.horizon = glm::dvec3(0.0);
    scene.sun.direction = {0.3, 0.5, -0.6};
    scene.sun.shadows = false;
    scene::validate(scene);
    return scene;
}

// Of samples at the centres of all pixels.
std::vector<glm::vec3> picture(const scene::Scene& scene, double right = 0.0) {
    std::vector<double> u, v;
    for (int y = 0; y < scene.film.height; ++y) {
        for (int x = 0; x < scene.film.width; ++x) {
            u.push_back(x + 0.5 + right);
            v.push_back(y + 0.5);
        }
    }
    const std::vector<double> t(u.size(), 0.0);
    std::vector<glm::vec3> radiance(u.size());
    Counters counters;
    SurfaceImage(scene, Tracer::fast).evaluate({u, v, t}, radiance, counters);
    return radiance;
}

const std::string kRock = "[[ground]]\nname = \"rock\"\ncolour = [0.5, 0.25, 0.125]\n";

}  // namespace

TEST_CASE("one smooth layer is Lambert: its reflectance times the sun's light") {
    const scene::Scene scene = level_ground(kRock);
    const double cosine = glm::normalize(scene.sun.direction).y;
    const glm::dvec3 expected = glm::dvec3(0.5, 0.25, 0.125) * scene.sun.colour * scene.sun.intensity * cosine / M_PI;
    for (const glm::vec3& radiance : picture(scene)) {
        if (radiance == glm::vec3(0.0f)) continue;  // the black sky
        for (int c = 0; c < 3; ++c) CHECK(radiance[c] == doctest::Approx(expected[c]).epsilon(1e-5));
    }
}

TEST_CASE("rough ground sends on what its lobe says towards the eye") {
    const scene::Scene smooth = level_ground(kRock), rough = level_ground(kRock + "roughness = 0.8\n");
    const std::vector<glm::vec3> even = picture(smooth), spread = picture(rough);
    const SurfaceImage image(rough, Tracer::fast);
    const shaders::RoughLobe lobe(0.8);
    int seen = 0;
    for (std::size_t i = 0; i < even.size(); ++i) {
        if (even[i] == glm::vec3(0.0f)) continue;
        ++seen;
        const double u = static_cast<double>(i % 64) + 0.5, v = static_cast<double>(i / 64) + 0.5;
        const glm::dvec3 to_eye = -image.camera_ray(u, v, 0.0).direction;
        const double share = lobe({0.0, 1.0, 0.0}, glm::normalize(rough.sun.direction), to_eye);
        for (int c = 0; c < 3; ++c) CHECK(spread[i][c] == doctest::Approx(share * even[i][c]).epsilon(1e-5));
    }
    CHECK(seen > 500);
}

TEST_CASE("patches far finer than a pixel do not sparkle: point samples beside each other are alike") {
    const std::string patches =
        kRock + "[[ground]]\nname = \"snow\"\nkind = \"fresh_snow\"\nnoise_from = 0.0\nnoise_edge = 0.05\n";
    const auto difference = [](const scene::Scene& scene) {
        const std::vector<glm::vec3> here = picture(scene, 0.0), beside = picture(scene, 1.0);
        double sum = 0.0;
        int seen = 0;
        for (std::size_t i = 0; i < here.size(); ++i) {
            if (here[i] == glm::vec3(0.0f) || beside[i] == glm::vec3(0.0f)) continue;
            sum += std::pow(here[i].g - beside[i].g, 2.0);
            ++seen;
        }
        return std::sqrt(sum / seen);
    };
    // A pixel of this picture is 0.03 to 1 units wide on the ground. Without what tells the material how much a sample
    // sees, patches of a thousandth would be black and white: snow is 0.67 brighter than rock.
    const double coarse = difference(level_ground(patches + "noise_size = 3.0\nnoise_octaves = 1\n"));
    const double fine = difference(level_ground(patches + "noise_size = 1e-3\nnoise_octaves = 4\n"));
    const double fractal = difference(level_ground(patches + "noise_size = 3.0\nnoise_octaves = 14\n"));
    MESSAGE("root mean square of neighbours: coarse ", coarse, ", fine ", fine, ", fractal ", fractal);
    CHECK(fine < 1e-3);
    CHECK(fractal < 0.12);
    CHECK(coarse > 0.0);
}
