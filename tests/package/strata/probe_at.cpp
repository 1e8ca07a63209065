// Prints rays and the field of the scene planet in the words of `strata probe`, to be compared with it.
#include <strata/strata.h>

#include <cstdio>

namespace {

void print(const char* name, const strata::Vector& v) {
    std::printf("\"%s\":[%.17g,%.17g,%.17g],", name, v[0], v[1], v[2]);
}

void print(const strata::RayResult& ray) {
    std::printf("{");
    print("origin", ray.origin);
    print("direction", ray.direction);
    const bool is_hit = ray.outcome == strata::Outcome::hit;
    std::printf("\"hit\":%s,", is_hit ? "true" : "false");
    if (is_hit) {
        std::printf("\"t\":%.17g,", ray.distance);
        print("position", ray.position);
        print("normal", ray.normal);
    } else {
        std::printf("\"t\":null,\"position\":null,\"normal\":null,");
    }
    std::printf("\"steps\":%u,\"noise_evaluations\":%u}\n", ray.steps, ray.noise_evaluations);
}

void print(const strata::FieldValue& field) {
    std::printf("{\"f\":%.17g,", field.f);
    print("gradient", field.gradient);
    std::printf("\"octaves\":[");
    for (const double& octave : field.octaves) {
        std::printf("%s%.17g", &octave == field.octaves.data() ? "" : ",", octave);
    }
    std::printf("]}\n");
}

}  // namespace

int main() {
    try {
        strata::Scene scene = strata::Scene::builtin("planet");
        scene.set("surface.spin_deg_per_s", 90);
        const strata::Probe probe(scene);
        print(probe.screen_ray(640.5, 360.5));
        print(probe.screen_ray(0.5, 0.5));
        print(probe.ray({0, 0, 100}, {0, 0.01, -3}));
        print(probe.ray({0, 0, 100}, {0, 0, 1}, 0.5));
        print(probe.field({1, 2, 3}));
        print(probe.field({1, 2, 3}, 0.25));
    } catch (const strata::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
