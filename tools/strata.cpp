// The strata program: one subcommand a file.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <clocale>
#include <cstdio>
#include <exception>

#include "src/image/image_error.h"
#include "src/scene/scene_error.h"
#include "src/scene/suggest.h"
#include "tools/commands.h"
#include "tools/errors.h"

namespace {

// The chosen subcommand, the innermost one.
const CLI::App& chosen(const CLI::App& program) {
    const auto commands = program.get_subcommands();
    return commands.empty() ? program : chosen(*commands.front());
}

std::vector<std::string> known_words(const CLI::App& command) {
    std::vector<std::string> words;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
    }
    for (const CLI::App* sub : command.get_subcommands(nullptr)) words.push_back(sub->get_name());
    return words;
}

// CLI11's message, and the option or command that was probably meant.
int usage_error(const CLI::App& program, const CLI::ParseError& error, int argc, char** argv) {
    const CLI::App& command = chosen(program);
    std::string message = error.what();
    const std::vector<std::string> words = known_words(command);
    for (int i = 1; i < argc; ++i) {
        std::string word = argv[i];
        word = word.substr(0, word.find('='));
        if (message.find(word) == std::string::npos) continue;
        if (const auto near = strata::scene::nearest(word, words); near && *near != word) {
            message += fmt::format("; did you mean '{}'?", *near);
            break;
        }
    }
    fmt::print(stderr, "strata: {}\nSee '{} --help'.\n", message,
               &command == &program ? "strata" : "strata " + command.get_name());
    return strata::tools::kExitUsage;
}

int fail(const std::exception& error, int exit_code) {
    fmt::print(stderr, "strata: {}\n", error.what());
    return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
    std::setlocale(LC_ALL, "C");
    CLI::App program("Procedural implicit surfaces, ray cast and antialiased with stratified B-spline samples.",
                     "strata");
    program.set_version_flag("--version", "strata " STRATA_VERSION);
    program.require_subcommand(1);
    program.failure_message(CLI::FailureMessage::simple);
    int exit_code = 0;
    strata::tools::add_render_command(program, exit_code);
    strata::tools::add_scenes_command(program, exit_code);
    strata::tools::add_probe_command(program, exit_code);
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& success) {
        return program.exit(success);
    } catch (const CLI::ParseError& error) {
        return usage_error(program, error, argc, argv);
    } catch (const strata::tools::UsageError& error) {
        return fail(error, strata::tools::kExitUsage);
    } catch (const strata::scene::SceneError& error) {
        return fail(error, strata::tools::kExitUsage);
    } catch (const std::exception& error) {
        return fail(error, strata::tools::kExitRuntime);
    }
    return exit_code;
}
