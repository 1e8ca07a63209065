#include "tools/job/column_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "src/scene/enum_names.h"
#include "src/scene/key_lookup.h"
#include "src/scene/key_text.h"
#include "src/scene/keys.h"
#include "src/scene/override.h"
#include "src/scene/suggest.h"
#include "src/scene/validate.h"
#include "tools/cli/errors.h"

namespace strata::tools::job {

namespace {

constexpr std::string_view kBlank = " \t\r\n";
constexpr std::string_view kLabel = "label";
constexpr std::string_view kAsItIs = "scene";

// Last parts that several sections have, or other names of keys; the sampling's win.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kShortNames{
    {{"l", "sampling.time_order"}, {"seed", "sampling.seed"}}};

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

cli::UsageError problem(std::string_view origin, std::string_view entry, const std::string& what) {
    return cli::UsageError(fmt::format("{} '{}': {}", origin, scene::excerpt(entry), what));
}

class Splitter {
  public:
    Splitter(std::string_view origin, std::string_view text) : origin_(origin), text_(text) {}

    std::vector<std::string_view> split(std::string_view separators) {
        std::vector<std::string_view> pieces;
        std::size_t begin = 0;
        for (std::size_t i = 0; i < text_.size(); ++i) {
            if (!is_outside(i) || separators.find(text_[i]) == std::string_view::npos) continue;
            pieces.push_back(trimmed(text_.substr(begin, i - begin)));
            begin = i + 1;
        }
        if (quote_ != 0 || depth_ != 0) {
            throw problem(origin_, text_, quote_ != 0 ? "a quote is not closed" : "brackets do not match");
        }
        pieces.push_back(trimmed(text_.substr(begin)));
        return pieces;
    }

  private:
    bool is_outside(std::size_t i) {
        const char c = text_[i];
        if (quote_ != 0) {
            const bool escaped = quote_ == '"' && i > 0 && text_[i - 1] == '\\';
            if (c == quote_ && !escaped) quote_ = 0;
            return false;
        }
        if (c == '"' || c == '\'') quote_ = c;
        if (c == '[' || c == '{') ++depth_;
        if ((c == ']' || c == '}') && --depth_ < 0) throw problem(origin_, text_, "brackets do not match");
        return quote_ == 0 && depth_ == 0;
    }

    std::string_view origin_;
    std::string_view text_;
    char quote_ = 0;
    int depth_ = 0;
};

// "label=it's 'x'" has its quotes taken off where they enclose it all.
std::string unquoted(std::string_view text) {
    const bool has_quotes =
        text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
    return std::string(has_quotes ? text.substr(1, text.size() - 2) : text);
}

std::string_view last_part(std::string_view full_name) { return full_name.substr(full_name.rfind('.') + 1); }

// "sampling.N=2" as "N = 2"; an estimator by its name alone.
std::string assignment_label(std::string_view assignment) {
    const auto equals = assignment.find('=');
    const std::string_view key = assignment.substr(0, equals);
    const std::string value = unquoted(assignment.substr(equals + 1));
    if (key == "sampling.estimator") return value == "none" ? "no antialiasing" : value;
    if (key == "sampling.time_order") return "l = " + value;
    return fmt::format("{} = {}", last_part(key), value);
}

std::string label_of(const std::vector<std::string>& assignments) {
    std::vector<std::string> parts;
    parts.reserve(assignments.size());
    for (const std::string& assignment : assignments) parts.push_back(assignment_label(assignment));
    return parts.empty() ? "as the scene says" : fmt::format("{}", fmt::join(parts, ", "));
}

// A word without '='.
std::string estimator_assignment(std::string_view origin, std::string_view entry, std::string_view word) {
    if (scene::from_name<scene::EstimatorKind>(word)) return fmt::format("sampling.estimator={}", word);
    const auto& names = scene::kEnumNames<scene::EstimatorKind>;
    const auto near = scene::nearest(word, std::vector<std::string>(names.begin(), names.end()));
    throw problem(origin, entry,
                  fmt::format("'{}' has no '=' and is no estimator, allowed: KEY=VALUE, {}, {}{}", scene::excerpt(word),
                              kAsItIs, fmt::join(names, ", "), near ? fmt::format(", did you mean '{}'?", *near) : ""));
}

ColumnSettings parse_entry(std::string_view origin, std::string_view entry) {
    ColumnSettings column;
    column.text = entry;
    for (const std::string_view word : Splitter(origin, entry).split(kBlank)) {
        if (word.empty() || word == kAsItIs) continue;
        const auto equals = word.find('=');
        if (equals == std::string_view::npos) {
            column.assignments.push_back(estimator_assignment(origin, entry, word));
        } else if (word.substr(0, equals) == kLabel) {
            column.label = unquoted(word.substr(equals + 1));
        } else {
            if (equals + 1 == word.size()) {
                throw problem(origin, entry, fmt::format("{} has no value (no blanks around '=')", word));
            }
            const std::string key =
                full_key_name(fmt::format("{} '{}'", origin, scene::excerpt(entry)), word.substr(0, equals));
            column.assignments.push_back(fmt::format("{}{}", key, word.substr(equals)));
        }
    }
    if (column.label.empty()) column.label = label_of(column.assignments);
    return column;
}

}  // namespace

std::vector<std::string_view> split_values(std::string_view origin, std::string_view text,
                                           std::string_view separators) {
    return Splitter(origin, text).split(separators);
}

std::string full_key_name(std::string_view origin, std::string_view name) {
    for (const auto& [short_name, full_name] : kShortNames) {
        if (name == short_name) return std::string(full_name);
    }
    if (name.starts_with("relief.")) return std::string(name);  // of the scene's own terms, and judged with it
    scene::Scene any;
    const std::vector<scene::Section> sections = scene::describe(any);
    const auto [section_name, last] = scene::key_path(name);
    const scene::Section* own = scene::find_section(sections, section_name);
    if (own && scene::find_key(*own, last)) return std::string(name);
    std::vector<std::string> found;
    for (const scene::Section& section : sections) {
        if (const scene::Key* key = scene::find_key(section, name)) found.push_back(key->full_name());
    }
    if (found.size() == 1) return found.front();
    if (found.size() > 1) {
        throw cli::UsageError(
            fmt::format("{}: {}: several keys end so, allowed: {}", origin, name, fmt::join(found, ", ")));
    }
    throw cli::UsageError(fmt::format("{}: {}", origin, scene::unknown_key(sections, section_name, last)));
}

std::vector<ColumnSettings> parse_columns(std::string_view origin, std::string_view text) {
    std::vector<ColumnSettings> columns;
    for (const std::string_view entry : Splitter(origin, text).split(";")) {
        if (entry.empty()) {
            throw problem(origin, text, "an entry is empty, allowed: entries such as none or N=4 m=4, between ';'");
        }
        columns.push_back(parse_entry(origin, entry));
    }
    return columns;
}

ColumnSettings parse_column(std::string_view origin, std::string_view text) {
    std::vector<ColumnSettings> columns = parse_columns(origin, text);
    if (columns.size() > 1) throw problem(origin, text, "several entries, allowed: one, without ';'");
    return std::move(columns.front());
}

scene::Scene with_settings(const scene::Scene& scene, const ColumnSettings& column, std::string_view origin) {
    const std::string typed = fmt::format("{} '{}'", origin, scene::excerpt(column.text));
    scene::Scene changed = scene;
    for (const std::string& assignment : column.assignments) scene::apply_override(changed, assignment, typed);
    scene::validate(changed, typed);
    return changed;
}

}  // namespace strata::tools::job
