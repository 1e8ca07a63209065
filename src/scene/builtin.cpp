#include "src/scene/builtin.h"

#include "src/scene/toml_reader.h"

namespace strata::scene {

namespace {

BuiltinScene builtin_scene(const BuiltinText& builtin) {
    const std::string name(builtin.name);
    return {name, read_scene(builtin.text, name + ".toml").title, builtin.text};
}

}  // namespace

std::vector<BuiltinScene> builtin_scenes() {
    std::vector<BuiltinScene> scenes;
    for (const BuiltinText& builtin : builtin_texts()) scenes.push_back(builtin_scene(builtin));
    return scenes;
}

std::optional<BuiltinScene> find_builtin(std::string_view name) {
    for (const BuiltinText& builtin : builtin_texts()) {
        if (builtin.name == name) return builtin_scene(builtin);
    }
    return std::nullopt;
}

}  // namespace strata::scene
