// The words that commands take: CLI11, apart. Its headers make objects in every file that includes them, which takes
// the compiler seconds a file, so command_line.cpp and strata.cpp alone do. Names and meanings are CLI11's.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "src/parallel/cancel.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace strata::tools::cli {

class Option {
  public:
    explicit Option(CLI::Option* option) : option_(option) {}

    // Shows the variable's present value, or this text, as the default in --help.
    Option* capture_default_str();
    Option* default_str(const std::string& text);

    Option* required();

    // May be given again and again, with one value each time.
    Option* repeated();

  private:
    CLI::Option* option_;
};

// A value from its text; throws UsageError that begins with the option's name.
using Read = std::function<void(const std::string& text)>;

class Command {
  public:
    // A program, which owns its commands.
    explicit Command(const std::string& description = {}, const std::string& name = {});
    ~Command();
    Command(const Command&) = delete;
    Command& operator=(const Command&) = delete;

    Command* add_subcommand(const std::string& name, const std::string& description);

    // One subcommand must be given, and no second.
    void require_subcommand();

    // An option, "-o,--output", or an argument, "SCENE", with its value, which must outlive parsing; `type` stands for
    // the value in --help. Of an option that is given again the last value counts, unless it is repeated() or takes
    // several. An empty value is refused; as an optional it is the command's to judge.
    Option* add_option(const std::string& names, std::string& value, const char* type, const std::string& meaning);
    Option* add_option(const std::string& names, std::optional<std::string>& value, const char* type,
                       const std::string& meaning);
    Option* add_option(const std::string& names, std::vector<std::string>& values, const char* type,
                       const std::string& meaning);
    void add_flag(const std::string& names, bool& value, const std::string& meaning);

    // Options with a type of their own: what was typed is read when all words were taken and none is wrong, in the
    // order of these calls, so that --help and unknown words come first. A whole number of [least,most], its present
    // value the default that --help shows:
    Option* add_option(const std::string& names, int& value, int least, int most, const char* type,
                       const std::string& meaning);
    Option* add_option(const std::string& names, std::optional<int>& value, int least, int most, const char* type,
                       const std::string& meaning);
    Option* add_option(const std::string& names, const Read& read, const char* type, const std::string& meaning);

    // The end of --help.
    void footer(const std::string& text);

    // What is done when the command was chosen and its words read; gives the program's exit code, if anything: else 0.
    template <class Run>
    void action(const Run& run) {
        set_action([run]() -> int {
            if constexpr (!std::is_void_v<decltype(run())>) return run();
            run();
            return 0;
        });
    }

    // How often an option was given.
    std::size_t count(const std::string& name) const;

    CLI::App& app() { return *app_; }

    // Of the action that was run.
    int exit_code() const { return *exit_code_; }

  private:
    struct Typed;

    Command(CLI::App* app, int* exit_code);
    void set_action(const std::function<int()>& run);
    Option* keep(CLI::Option* option, const char* type);

    int own_exit_code_ = 0;
    std::unique_ptr<CLI::App> program_;  // null in a subcommand
    CLI::App* app_;
    int* exit_code_;  // the program's
    std::vector<std::unique_ptr<Command>> subcommands_;
    std::deque<Option> options_;  // where they are pointed to
    std::list<Typed> typed_;      // which, unlike a deque, may be of a type that is complete later
};

// The first name of "-N,--samples", as messages have it.
std::string shown_name(const std::string& names);

// An integer of [least,most] given to an option. Throws UsageError.
int parse_integer(const std::string& option, const std::string& text, int least, int most);

// The words between commas, empty ones too.
std::vector<std::string> split_at_commas(const std::string& text);

// Which of the known names the words between commas are. Throws UsageError for a word that is no such `noun`, with the
// nearest name.
std::vector<std::size_t> parse_names(const std::string& option, const char* noun, const std::string& text,
                                     const std::vector<std::string>& known);

// Cancelled from now on by SIGINT, SIGTERM and SIGHUP (parallel::cancel_on_signals).
parallel::CancelToken& cancel_by_signals();

// A command's end: failed on the way unless all was written, else by the signal that came, however late, since that is
// why the user expects an end; else 0.
int exit_code_of(bool all_written);

}  // namespace strata::tools::cli
