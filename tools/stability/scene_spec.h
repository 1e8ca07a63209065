// A built-in scene with keys replaced, as a command line would name it, so that every ray of a case can be replayed.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "src/scene/scene.h"

namespace strata::tools::stability {

struct SceneSpec {
    std::string name;
    std::vector<std::string> sets;  // "camera.far=1e12"

    // Throws SceneError for what a command line would be refused for.
    scene::Scene scene() const;

    // "strata probe ray planet --set ...", with what follows.
    std::string command(const std::string& words, const std::string& more = {}) const;
};

// "[x,y,z]" with 17 digits.
std::string vector_text(const glm::dvec3& v);

// "camera.position=[x,y,z]".
std::string set_vector(const std::string& key, const glm::dvec3& v);
std::string set_number(const std::string& key, double value);

}  // namespace strata::tools::stability
