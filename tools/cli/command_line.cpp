#include "tools/cli/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "src/scene/key_text.h"
#include "src/scene/suggest.h"
#include "src/scene/typed_number.h"
#include "tools/cli/errors.h"

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

struct Command::Typed {
    CLI::Option* option = nullptr;
    std::vector<std::string> texts;  // one, unless it is repeated()
    Read read;
};

Option* Option::capture_default_str() {
    option_->capture_default_str();
    return this;
}

Option* Option::default_str(const std::string& text) {
    option_->default_str(text);
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
    : program_(std::make_unique<CLI::App>(description, name)), app_(program_.get()), exit_code_(&own_exit_code_) {}

Command::Command(CLI::App* app, int* exit_code) : app_(app), exit_code_(exit_code) {}

Command::~Command() = default;

Command* Command::add_subcommand(const std::string& name, const std::string& description) {
    subcommands_.emplace_back(new Command(app_->add_subcommand(name, description), exit_code_));
    return subcommands_.back().get();
}

void Command::require_subcommand() { app_->require_subcommand(1); }

Option* Command::keep(CLI::Option* option, const char* type) {
    if (*type != '\0') option->type_name(type);
    return &options_.emplace_back(option);
}

Option* Command::add_option(const std::string& names, std::string& value, const char* type,
                            const std::string& meaning) {
    return keep(not_empty(last_counts(app_->add_option(names, value, meaning))), type);
}

Option* Command::add_option(const std::string& names, std::optional<std::string>& value, const char* type,
                            const std::string& meaning) {
    return keep(last_counts(app_->add_option(names, value, meaning)), type);
}

Option* Command::add_option(const std::string& names, std::vector<std::string>& values, const char* type,
                            const std::string& meaning) {
    return keep(app_->add_option(names, values, meaning), type);
}

Option* Command::add_option(const std::string& names, const Read& read, const char* type, const std::string& meaning) {
    Typed& typed = typed_.emplace_back();
    typed.option =
        not_empty(last_counts(app_->add_option(names, typed.texts, meaning)->expected(1)->allow_extra_args(false)));
    typed.read = read;
    return keep(typed.option, type);
}

Option* Command::add_option(const std::string& names, int& value, int least, int most, const char* type,
                            const std::string& meaning) {
    const auto read = [&value, name = shown_name(names), least, most](const std::string& text) {
        value = parse_integer(name, text, least, most);
    };
    return add_option(names, read, type, meaning)->default_str(fmt::format("{}", value));
}

Option* Command::add_option(const std::string& names, std::optional<int>& value, int least, int most, const char* type,
                            const std::string& meaning) {
    const auto read = [&value, name = shown_name(names), least, most](const std::string& text) {
        value = parse_integer(name, text, least, most);
    };
    return add_option(names, read, type, meaning);
}

void Command::add_flag(const std::string& names, bool& value, const std::string& meaning) {
    app_->add_flag(names, value, meaning);
}

void Command::footer(const std::string& text) { app_->footer(text); }

void Command::set_action(const std::function<int()>& run) {
    app_->callback([this, run] {
        for (const Typed& typed : typed_) {
            for (const std::string& text : typed.texts) typed.read(text);
        }
        *exit_code_ = run();
    });
}

std::size_t Command::count(const std::string& name) const { return app_->count(name); }

std::string shown_name(const std::string& names) { return names.substr(0, names.find(',')); }

int parse_integer(const std::string& option, const std::string& text, int least, int most) {
    const auto value = scene::typed_integer<int>(text);
    if (value && *value >= least && *value <= most) return *value;
    throw UsageError(
        fmt::format("{} {}: allowed: a whole number, {} to {}", option, scene::excerpt(text), least, most));
}

std::vector<std::string> split_at_commas(const std::string& text) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= text.size(); begin += words.back().size() + 1) {
        words.push_back(text.substr(begin, text.find(',', begin) - begin));
    }
    return words;
}

std::vector<std::size_t> parse_names(const std::string& option, const char* noun, const std::string& text,
                                     const std::vector<std::string>& known) {
    std::vector<std::size_t> chosen;
    for (const std::string& word : split_at_commas(text)) {
        const auto found = std::ranges::find(known, word);
        if (found == known.end()) {
            const auto near = scene::nearest(word, known);
            throw UsageError(fmt::format("{}: '{}' is no {}, allowed: {}{}", option, scene::excerpt(word), noun,
                                         fmt::join(known, ", "),
                                         near ? fmt::format("; did you mean '{}'?", *near) : ""));
        }
        chosen.push_back(static_cast<std::size_t>(found - known.begin()));
    }
    return chosen;
}

parallel::CancelToken& cancel_by_signals() {
    static parallel::CancelToken cancel;
    parallel::cancel_on_signals(cancel);
    return cancel;
}

int exit_code_of(bool all_written) {
    if (!all_written) return kExitRuntime;
    return parallel::cancelling_signal() != 0 ? kExitSignal + parallel::cancelling_signal() : 0;
}

}  // namespace strata::tools::cli
