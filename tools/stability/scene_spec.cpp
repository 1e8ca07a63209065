#include "tools/stability/scene_spec.h"

#include <fmt/format.h>

#include <stdexcept>

#include "src/scene/builtin.h"
#include "src/scene/override.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"

namespace strata::tools::stability {

scene::Scene SceneSpec::scene() const {
    const auto builtin = scene::find_builtin(name);
    if (!builtin) throw std::logic_error("no built-in scene " + name);
    scene::Scene result = scene::read_scene(builtin->text, name);
    for (const std::string& set : sets) scene::apply_override(result, set);
    scene::validate(result, name);
    return result;
}

std::string SceneSpec::command(const std::string& words, const std::string& more) const {
    std::string text = fmt::format("strata {} {}", words, name);
    for (const std::string& set : sets) {
        const bool quoted = set.find('[') != std::string::npos;
        text += fmt::format(" --set {0}{1}{0}", quoted ? "'" : "", set);
    }
    return more.empty() ? text : text + " " + more;
}

std::string vector_text(const glm::dvec3& v) { return fmt::format("[{:.17g},{:.17g},{:.17g}]", v.x, v.y, v.z); }

std::string set_vector(const std::string& key, const glm::dvec3& v) { return key + "=" + vector_text(v); }

std::string set_number(const std::string& key, double value) { return fmt::format("{}={:.17g}", key, value); }

}  // namespace strata::tools::stability
