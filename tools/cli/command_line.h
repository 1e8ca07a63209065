// The words that commands take: CLI11, apart. Its headers make objects in every file that includes them, which takes
// the compiler seconds a file, so command_line.cpp and strata.cpp alone do. Names and meanings are CLI11's.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace strata::tools::cli {

class Option {
  public:
    explicit Option(CLI::Option* option) : option_(option) {}

    // What stands for the value in --help.
    Option* type_name(const std::string& name);

    // Shows the variable's present value as the default in --help.
    Option* capture_default_str();

    Option* required();

    // May be given again and again, with one value each time.
    Option* repeated();

  private:
    CLI::Option* option_;
};

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

    // An option, "-o,--output", or an argument, "SCENE", with its value, which must outlive parsing. Of an option that
    // is given again the last value counts, unless it is repeated() or takes several. An empty value is refused; as an
    // optional it is the command's to judge.
    Option* add_option(const std::string& names, std::string& value, const std::string& meaning);
    Option* add_option(const std::string& names, std::optional<std::string>& value, const std::string& meaning);
    Option* add_option(const std::string& names, std::vector<std::string>& values, const std::string& meaning);
    void add_flag(const std::string& names, bool& value, const std::string& meaning);

    // The end of --help.
    void footer(const std::string& text);

    // What is done when the command was chosen and its words read.
    void callback(const std::function<void()>& run);

    // How often an option was given.
    std::size_t count(const std::string& name) const;

    // Reads the words after the program's name and calls back. Throws CLI11's errors, and what is thrown back.
    void parse(std::vector<std::string> words);

    CLI::App& app() { return *app_; }

  private:
    explicit Command(CLI::App* app);
    Option* keep(CLI::Option* option) { return &options_.emplace_back(option); }

    std::unique_ptr<CLI::App> program_;  // null in a subcommand
    CLI::App* app_;
    std::vector<std::unique_ptr<Command>> subcommands_;
    std::deque<Option> options_;  // where they are pointed to
};

}  // namespace strata::tools::cli
