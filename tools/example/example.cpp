// The strata library in one small program: a scene, changed by name; a picture of it; a ray through the middle of it.
//
//     find_package(Strata 0.1 REQUIRED)            in CMakeLists.txt, after project()
//     add_executable(example example.cpp)
//     target_link_libraries(example PRIVATE Strata::strata)
//
// and then `cmake -B build -DCMAKE_PREFIX_PATH=WHERE_STRATA_IS_INSTALLED && cmake --build build`.
#include <strata/strata.h>

#include <cstdio>

int main(int count, char** arguments) {
    try {
        // A scene file, or a picture that Strata wrote; without an argument, a scene that comes with the library.
        strata::Scene scene = count > 1 ? strata::Scene::load(arguments[1]) : strata::Scene::builtin("terrain");

        // Any key of a scene, by its name: scene.keys() lists them all with what they allow.
        scene.set("film.width", 160);
        scene.set("film.height", 90);
        scene.set("sampling.N", 2);
        scene.set("camera.fov_deg", 40.0);
        scene.set("sampling.estimator", "stratified");

        // Progress comes at most ten times a second; a std::stop_token in `stop` would end the render early.
        strata::RenderOptions options;
        options.on_progress = [](const strata::Progress& progress) {
            std::fprintf(stderr, "%3.0f %% of some %.1f s\n", 100 * progress.fraction, progress.expected.count());
        };
        const strata::RenderReport report =
            strata::render_file(scene, "example.exr", options, {.exr_format = strata::ExrFormat::single});
        std::printf("%llu rays in %.2f s\n", static_cast<unsigned long long>(report.rays), report.elapsed.count());

        // What the middle of the picture shows, and how high a point is over the surface there.
        const strata::Probe probe(scene);
        const strata::RayResult middle = probe.screen_ray(80, 45);
        if (middle.outcome == strata::Outcome::hit) {
            std::printf("hit at (%g, %g, %g), %g away\n", middle.position[0], middle.position[1], middle.position[2],
                        middle.distance);
            std::printf("f there: %g\n", probe.field(middle.position).f);
        }
    } catch (const strata::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());  // where, what, and what is allowed
        return 1;
    }
}
