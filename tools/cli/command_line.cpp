#include "tools/cli/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>

namespace strata::tools::cli {

namespace {

// Of an option given twice: what a script appends to a line overrides what stands there. Arguments, which have no
// name, are not repeated but too many.
CLI::Option* last_counts(CLI::Option* option) {
    if (!option->get_positional()) option->take_last();
    return option;
}

// A script's unset variable is no wish for the default.
CLI::Option* not_empty(CLI::Option* option) {
    return option->check([](const std::string& value) {
        return std::string(value.empty() ? "an empty value; without the option its default is taken" : "");
    });
}

}  // namespace

Option* Option::type_name(const std::string& name) {
    option_->type_name(name);
    return this;
}

Option* Option::capture_default_str() {
    option_->capture_default_str();
    return this;
}

Option* Option::required() {
    option_->required();
    return this;
}

Option* Option::repeated() {
    option_->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    return this;
}

Command::Command(const std::string& description, const std::string& name)
    : program_(std::make_unique<CLI::App>(description, name)), app_(program_.get()) {}

Command::Command(CLI::App* app) : app_(app) {}

Command::~Command() = default;

Command* Command::add_subcommand(const std::string& name, const std::string& description) {
    subcommands_.emplace_back(new Command(app_->add_subcommand(name, description)));
    return subcommands_.back().get();
}

void Command::require_subcommand() { app_->require_subcommand(1); }

Option* Command::add_option(const std::string& names, std::string& value, const std::string& meaning) {
    return keep(not_empty(last_counts(app_->add_option(names, value, meaning))));
}

Option* Command::add_option(const std::string& names, std::optional<std::string>& value, const std::string& meaning) {
    return keep(last_counts(app_->add_option(names, value, meaning)));
}

Option* Command::add_option(const std::string& names, std::vector<std::string>& values, const std::string& meaning) {
    return keep(app_->add_option(names, values, meaning));
}

void Command::add_flag(const std::string& names, bool& value, const std::string& meaning) {
    app_->add_flag(names, value, meaning);
}

void Command::footer(const std::string& text) { app_->footer(text); }

void Command::callback(const std::function<void()>& run) { app_->callback(run); }

std::size_t Command::count(const std::string& name) const { return app_->count(name); }

void Command::parse(std::vector<std::string> words) {
    std::ranges::reverse(words);  // CLI11 takes them from the end
    app_->parse(words);
}

}  // namespace strata::tools::cli
