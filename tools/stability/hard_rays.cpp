#include "tools/stability/hard_rays.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace strata::tools::stability {

glm::dvec3 surface_point(const trace::Field& field, glm::dvec3 outside, glm::dvec3 inside) {
    for (int i = 0; i < 110; ++i) {
        const glm::dvec3 middle = 0.5 * (outside + inside);
        (field.value(middle) > 0.0 ? outside : inside) = middle;
    }
    return outside;
}

double uniform(Random& random, double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); }

double log_uniform(Random& random, double a, double b) { return std::exp(uniform(random, std::log(a), std::log(b))); }

glm::dvec3 unit_vector(Random& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

namespace {

// A random point of the surface, the last double outside it along a line; nothing if the line misses it.
std::optional<glm::dvec3> random_surface_point(const trace::Field& field, Random& random) {
    // A surface without noise wants a little to both sides as well.
    const double height = 1.01 * field.amplitude() + 1e-9 * std::max(1.0, std::abs(field.base(glm::dvec3(0.0))));
    const double ball = field.extent().ball, wide = std::isfinite(ball) ? 0.6 * ball : 60.0;
    const auto anywhere = [&] { return uniform(random, 0.0, wide) * unit_vector(random); };
    const glm::dvec3 x = anywhere();
    const bool is_level_set = field.base_gradient(x) == glm::dvec3(0.0);
    const glm::dvec3 outside = solid::over(field.solid(), x, height);
    const glm::dvec3 inside = is_level_set ? anywhere() : solid::over(field.solid(), x, -height);
    if (field.value(outside) <= 0.0 || field.value(inside) > 0.0) return std::nullopt;
    return surface_point(field, outside, inside);
}

}  // namespace

// Tangents lifted or sunk by 1e-12 to 1e-3 of a lattice cell, most by no more than 1e-6.
std::vector<WorldRay> grazing_rays(const RayJury& jury, Random& random, int count) {
    const double cell = 1.0 / jury.scene().surface.frequency;
    std::vector<WorldRay> rays;
    for (int tries = 0; static_cast<int>(rays.size()) < count && tries < 40 * count; ++tries) {
        const auto x = random_surface_point(jury.field(), random);
        if (!x) continue;
        const glm::dvec3 normal = glm::normalize(jury.field().gradient(*x));
        const glm::dvec3 tangent = glm::normalize(glm::cross(normal, unit_vector(random)));
        const double lift = cell * std::pow(10.0, uniform(random, -12.0, tries % 4 == 0 ? -3.0 : -6.0));
        const glm::dvec3 from = *x + (tries % 2 ? lift : -lift) * normal - uniform(random, 0.0, 0.4) * cell * tangent;
        rays.push_back({.origin = from, .direction = tangent, .pixel = {}});
    }
    return rays;
}

// Level along crests: from a point of greatest height across, found by ascent, in both directions of least curvature,
// lifted or sunk by up to 1e-6 of a cell.
std::vector<WorldRay> ridge_rays(const RayJury& jury, Random& random, int count) {
    const trace::Field& field = jury.field();
    const double cell = 1.0 / jury.scene().surface.frequency;
    std::vector<WorldRay> rays;
    while (static_cast<int>(rays.size()) < count) {
        glm::dvec3 x{uniform(random, -40.0, 40.0), 0.0, uniform(random, -40.0, 40.0)};
        // The gradient of y - h is (-h_x, 1, -h_z): walk against it, by ever shorter steps.
        for (double step = 0.1 * cell; step > 1e-7 * cell; step *= 0.97) {
            const glm::dvec3 g = field.gradient(x);
            const glm::dvec3 up = glm::dvec3(-g.x, 0.0, -g.z);
            if (glm::length(up) == 0.0) break;
            x += step * glm::normalize(up);
        }
        x.y = 0.0;
        const double height = -field.value(x);
        glm::dvec3 along{1.0, 0.0, 0.0};
        double flattest = 1e300;
        for (int k = 0; k < 32; ++k) {
            const double angle = 0.0981747704246810387 * k, reach = 0.05 * cell;
            const glm::dvec3 d{std::cos(angle), 0.0, std::sin(angle)};
            const double drop = std::abs(2.0 * height + field.value(x + reach * d) + field.value(x - reach * d));
            if (drop < flattest) flattest = drop, along = d;
        }
        const double lift = cell * std::pow(10.0, uniform(random, -13.0, -6.0)) * (random() % 2 ? 1.0 : -1.0);
        rays.push_back(
            {.origin = glm::dvec3(x.x, height + lift, x.z) - 0.3 * cell * along, .direction = along, .pixel = {}});
    }
    return rays;
}

// From the last double outside, the first inside and deep inside, along the normal, against it, across it and anywhere.
std::vector<WorldRay> starting_rays(const RayJury& jury, Random& random, int count) {
    std::vector<WorldRay> rays;
    for (int tries = 0; static_cast<int>(rays.size()) < count && tries < 40 * count; ++tries) {
        const auto x = random_surface_point(jury.field(), random);
        if (!x) continue;
        const glm::dvec3 normal = glm::normalize(jury.field().gradient(*x));
        const glm::dvec3 tangent = glm::normalize(glm::cross(normal, unit_vector(random)));
        const double size = std::max(1.0, glm::length(*x));
        const glm::dvec3 from = *x - (tries % 3 == 0 ? 0.0 : tries % 3 == 1 ? 4e-16 * size : 0.1) * normal;
        for (const glm::dvec3& direction : {normal, -normal, tangent, unit_vector(random)}) {
            rays.push_back({.origin = from, .direction = direction, .pixel = {}});
        }
    }
    return rays;
}

// Pixels anywhere, and pairs of neighbours about the silhouettes of columns: between a hit and a miss above it.
std::vector<WorldRay> pixel_rays(const RayJury& jury, Random& random, int count) {
    const scene::Film& film = jury.scene().film;
    const auto at = [](int x, int y) { return WorldRay{.pixel = glm::ivec2(x, y)}; };
    const auto hits = [&](const WorldRay& ray) {
        const trace::Ray local = jury.local(ray);
        return jury.trace({&local, 1}).front().state == trace::HitState::hit;
    };
    std::vector<WorldRay> rays;
    for (int i = 0; i < count; ++i) {
        const int x = static_cast<int>(random() % static_cast<unsigned>(film.width));
        if (i % 3 != 0) {
            rays.push_back(at(x, static_cast<int>(random() % static_cast<unsigned>(film.height))));
            continue;
        }
        int miss = 0, hit = film.height - 1;
        if (!hits(at(x, hit)) || hits(at(x, miss))) continue;
        while (hit - miss > 1) (hits(at(x, (hit + miss) / 2)) ? hit : miss) = (hit + miss) / 2;
        rays.push_back(at(x, miss));
        rays.push_back(at(x, hit));
    }
    return rays;
}

}  // namespace strata::tools::stability
