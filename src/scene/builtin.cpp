#include "src/scene/builtin.h"

#include "src/scene/toml_reader.h"

namespace strata::scene {

namespace {

// As it was asked for: outputs are named so.
BuiltinScene builtin_scene(std::string_view asked, const BuiltinText& builtin) {
    const std::string name(asked);
    return {name, read_scene(builtin.text, name + ".toml").title, builtin.text};
}

std::string_view own_name(std::string_view name) { return name == "terrain" ? "hills" : name; }

}  // namespace

std::vector<BuiltinScene> builtin_scenes() {
    std::vector<BuiltinScene> scenes;
    for (const BuiltinText& builtin : builtin_texts()) scenes.push_back(builtin_scene(builtin.name, builtin));
    return scenes;
}

std::optional<BuiltinScene> find_builtin(std::string_view name) {
    for (const BuiltinText& builtin : builtin_texts()) {
        if (builtin.name == own_name(name)) return builtin_scene(name, builtin);
    }
    return std::nullopt;
}

}  // namespace strata::scene
