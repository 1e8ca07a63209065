// fBm and its gradient at points of stdin, `x y z` a line: prints the value, its rounding bound, the gradient and its
// rounding bound.
#include <strata/noise.h>

#include <cstdio>

int main() {
    try {
        const strata::Fbm<3> fbm({.octaves = 8, .lacunarity = 2.0, .gain = 0.5, .amplitude = 0.6, .frequency = 0.5});
        strata::FbmPoints<3> points;
        double& x = points.origin[0];
        double& y = points.origin[1];
        double& z = points.origin[2];
        while (std::scanf("%lf %lf %lf", &x, &y, &z) == 3) {
            const float zero = 0.0f;
            float value = 0.0f;
            std::array<float, 3> slope{};
            points.offset = {std::span(&zero, 1), std::span(&zero, 1), std::span(&zero, 1)};
            fbm.gradients(points, {&value, 1},
                          {std::span(&slope[0], 1), std::span(&slope[1], 1), std::span(&slope[2], 1)});
            const strata::Rounding rounding = fbm.rounding(100.0, 0.0);
            std::printf("%.9g %.9g %.9g %.9g %.9g %.9g\n", value, rounding.value, slope[0], slope[1], slope[2],
                        rounding.gradient);
        }
    } catch (const strata::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
