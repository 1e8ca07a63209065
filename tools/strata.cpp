// The strata program: one subcommand a file.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <clocale>
#include <exception>
#include <new>
#include <sstream>

#include "src/parallel/cancel.h"
#include "src/scene/key_text.h"
#include "src/scene/scene_error.h"
#include "src/scene/suggest.h"
#include "tools/cli/command_line.h"
#include "tools/cli/endings.h"
#include "tools/cli/errors.h"
#include "tools/cli/process.h"
#include "tools/cli/standard_output.h"

// Each is a folder tools/NAME, in whose command.cpp add_command() adds it to the program.
#define STRATA_COMMANDS(use)                                                                                    \
    use(render) use(merge) use(farm) use(scene_list) use(probe) use(strip) use(sweep) use(animate) use(gallery) \
        use(figures) use(converge) use(stability) use(explain) use(bench)

#define STRATA_DECLARE(name)                 \
    namespace strata::tools::name {          \
    void add_command(cli::Command& program); \
    }
STRATA_COMMANDS(STRATA_DECLARE)

namespace {

using Words = std::vector<std::string>;

// The chosen subcommand, the innermost one, and how it is called: "strata probe ray".
struct Chosen {
    const CLI::App* command;
    std::string call;
};

Chosen chosen(const CLI::App& program) {
    Chosen innermost{&program, program.get_name()};
    while (!innermost.command->get_subcommands().empty()) {
        innermost.command = innermost.command->get_subcommands().front();
        innermost.call += " " + innermost.command->get_name();
    }
    return innermost;
}

Words subcommands_of(const CLI::App& command) {
    Words names;
    for (const CLI::App* sub : command.get_subcommands(nullptr)) names.push_back(sub->get_name());
    return names;
}

Words options_of(const CLI::App& command) {
    Words names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    }
    return names;
}

std::string suggestion(const std::string& word, const Words& known) {
    const auto near = strata::scene::nearest(word, known);
    return near ? fmt::format(", did you mean '{}'?", *near) : "";
}

// What is wrong with a word that the command has no use for.
std::string unknown_word(const Chosen& innermost, const std::string& word) {
    const std::string shown = strata::scene::excerpt(word);
    if (word.size() > 1 && word.front() == '-') {
        const std::string name = word.substr(0, word.find('='));
        const Words options = options_of(*innermost.command);
        const std::string near = suggestion(name, options);
        return fmt::format("{}: unknown option of '{}'{}", shown, innermost.call,
                           near.empty() ? fmt::format(", allowed: {}", fmt::join(options, ", ")) : near);
    }
    const Words subcommands = subcommands_of(*innermost.command);
    if (subcommands.empty()) return fmt::format("{}: one argument too many for '{}'", shown, innermost.call);
    return fmt::format("{}: unknown command of '{}', allowed: {}{}", shown, innermost.call,
                       fmt::join(subcommands, ", "), suggestion(word, subcommands));
}

std::string usage_problem(const Chosen& innermost, const CLI::ParseError& error) {
    const Words unused = innermost.command->remaining();
    if (!unused.empty()) return unknown_word(innermost, unused.front());
    const Words subcommands = subcommands_of(*innermost.command);
    if (subcommands.empty()) return error.what();
    return fmt::format("'{}' needs a command, one of: {}", innermost.call, fmt::join(subcommands, ", "));
}

int usage_error(const CLI::App& program, const CLI::ParseError& error) {
    const Chosen innermost = chosen(program);
    strata::tools::cli::print_error(
        fmt::format("{}\nSee '{} --help'.", usage_problem(innermost, error), innermost.call));
    return strata::tools::cli::kExitUsage;
}

int fail(const char* message, int exit_code) {
    strata::tools::cli::print_error(message);
    return exit_code;
}

// --help and --version.
int answer(const CLI::App& program, const CLI::Success& request) {
    std::ostringstream text;
    program.exit(request, text, text);
    strata::tools::cli::print_out(text.str());
    return 0;
}

int run(int argc, char** argv) {
    strata::tools::cli::Command commands(
        "Procedural implicit surfaces, ray cast and antialiased with stratified B-spline samples.", "strata");
    CLI::App& program = commands.app();
    program.set_version_flag("--version", "strata " STRATA_VERSION, "Print the program's version");
    commands.require_subcommand();
#define STRATA_ADD(name) strata::tools::name::add_command(commands);
    STRATA_COMMANDS(STRATA_ADD)
    // Commands added later would inherit it.
    program.footer("'strata COMMAND --help' explains each. `strata render` without more renders the scene alpenglow.");
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& request) {
        return answer(program, request);
    } catch (const CLI::ParseError& error) {
        return usage_error(program, error);
    } catch (const strata::tools::cli::UsageError& error) {
        return fail(error.what(), strata::tools::cli::kExitUsage);
    } catch (const strata::scene::SceneError& error) {
        return fail(error.what(), strata::tools::cli::kExitUsage);
    } catch (const std::bad_alloc&) {
        return fail("out of memory; a smaller --size, or --crop, needs less", strata::tools::cli::kExitRuntime);
    } catch (const strata::tools::cli::ProcessError& error) {
        // The signal that stopped this program stopped the one that it ran.
        const int signal = strata::parallel::cancelling_signal();
        return fail(error.what(),
                    signal != 0 ? strata::tools::cli::kExitSignal + signal : strata::tools::cli::kExitRuntime);
    } catch (const std::exception& error) {
        return fail(strata::tools::cli::message_of(error).c_str(), strata::tools::cli::kExitRuntime);
    }
    return commands.exit_code();
}

}  // namespace

int main(int argc, char** argv) {
    std::setlocale(LC_ALL, "C");
    strata::tools::cli::guard_standard_streams();
    strata::tools::cli::prepare_endings();
    return strata::tools::cli::finish_output(run(argc, argv));
}
