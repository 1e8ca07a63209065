// Random numbers as tests draw them.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <random>

namespace strata::support {

using Random = std::mt19937_64;

inline double uniform(Random& random, double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
}

inline double log_uniform(Random& random, double a, double b) {
    return std::exp(uniform(random, std::log(a), std::log(b)));
}

inline glm::dvec3 unit_vector(Random& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

}  // namespace strata::support
