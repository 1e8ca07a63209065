#include <fmt/format.h>

#include "src/scene/builtin.h"
#include "src/scene/printer.h"
#include "src/scene/suggest.h"
#include "src/scene/toml_reader.h"
#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"
#include "tools/cli/standard_output.h"
#include "tools/scene_list/relief_list.h"

namespace strata::tools::scene_list {

namespace {

void list_scenes() {
    for (const scene::BuiltinScene& builtin : scene::builtin_scenes()) {
        cli::print_out(fmt::format("{:<14}{}\n", builtin.name, builtin.title));
    }
}

void print_builtin(const std::string& name) {
    const auto builtin = scene::find_builtin(name);
    if (!builtin) {
        std::vector<std::string> names;
        for (const scene::BuiltinScene& known : scene::builtin_scenes()) names.push_back(known.name);
        const auto near = scene::nearest(name, names);
        throw cli::UsageError(fmt::format("{}: no built-in scene of this name; `strata scenes` lists them{}", name,
                                          near ? fmt::format(", did you mean '{}'?", *near) : ""));
    }
    const scene::Scene scene = scene::read_scene(builtin->text, builtin->name);
    cli::print_out(scene::print_scene(scene, scene::PrintedKeys::all));
}

}  // namespace

void add_command(cli::Command& program) {
    cli::Command* command =
        program.add_subcommand("scenes", "List the built-in scenes, or print one with every key explained");
    auto name = std::make_shared<std::string>();
    command->add_option("NAME", *name, "", "The scene to print as TOML: every key, its default, unit and range");
    command->footer("A printed scene is a scene file: save it, change it, render it.");
    auto relief = std::make_shared<bool>(false);
    command->add_flag("--relief", *relief, "List the kinds of [[relief]] terms with their keys and bounds instead");
    command->action([name, relief] {
        if (*relief) return cli::print_out(relief_list());
        return name->empty() ? list_scenes() : print_builtin(*name);
    });
}

}  // namespace strata::tools::scene_list
