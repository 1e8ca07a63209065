#include "src/journal/identity.h"

#include <fmt/format.h>

#include <map>
#include <set>

namespace strata::journal {
namespace {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r";
    const std::size_t first = text.find_first_not_of(kBlank);
    return first == text.npos ? "" : text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

// Without the remark behind it, which begins at a # outside of quotes.
std::string_view without_remark(std::string_view line) {
    bool is_quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"') is_quoted = !is_quoted;
        if (line[i] == '#' && !is_quoted) return line.substr(0, i);
    }
    return line;
}

// "name", "name#2", "name#3".
std::string numbered(std::map<std::string, int, std::less<>>& counts, std::string name) {
    const int count = ++counts[name];
    return count == 1 ? name : fmt::format("{}#{}", name, count);
}

// Long values are cut: a whole list of camera keys helps nobody.
std::string shown(std::string_view value) {
    constexpr std::size_t kMost = 60;
    if (value.empty()) return "nothing";
    return value.size() <= kMost ? std::string(value) : fmt::format("{}...", value.substr(0, kMost));
}

}  // namespace

void Identity::set_lines(std::string_view text) {
    std::map<std::string, int, std::less<>> counts;
    std::string section;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        const std::string_view content = trimmed(without_remark(line));
        if (content.empty()) continue;
        if (content.front() == '[') {
            const std::size_t begin = content.find_first_not_of('[');
            section = numbered(counts, std::string(content.substr(begin, content.find(']') - begin)));
            set(section, "section");
            continue;
        }
        const std::size_t sign = content.find('=');
        const std::string name =
            fmt::format("{}{}{}", section, section.empty() ? "" : ".", trimmed(content.substr(0, sign)));
        set(numbered(counts, name), std::string(sign == content.npos ? "" : trimmed(content.substr(sign + 1))));
    }
}

void Identity::write(PayloadWriter& payload) const {
    payload.put<std::uint32_t>(static_cast<std::uint32_t>(entries_.size()));
    for (const auto& [name, value] : entries_) {
        payload.put_text(name);
        payload.put_text(value);
    }
}

Identity Identity::read(PayloadReader& payload) {
    Identity identity;
    const auto count = payload.take<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
        std::string name = payload.take_text();
        identity.set(std::move(name), payload.take_text());
    }
    return identity;
}

std::vector<std::string> differences(const Identity& there, const Identity& here, std::size_t most) {
    const std::map<std::string, std::string> old(there.entries().begin(), there.entries().end());
    const std::map<std::string, std::string> now(here.entries().begin(), here.entries().end());
    std::vector<std::string> lines;
    const auto add = [&](const std::string& name, const std::string* a, const std::string* b) {
        lines.push_back(fmt::format("{}: {} there, {} here", name, a != nullptr ? shown(*a) : "nothing",
                                    b != nullptr ? shown(*b) : "nothing"));
    };
    for (const auto& [name, value] : now) {
        const auto found = old.find(name);
        if (found == old.end())
            add(name, nullptr, &value);
        else if (found->second != value)
            add(name, &found->second, &value);
    }
    for (const auto& [name, value] : old) {
        if (!now.contains(name)) add(name, &value, nullptr);
    }
    // Equal in all names and yet not equal: in their order, which a scene's repeated sections give a meaning.
    if (lines.empty() && !(there == here)) lines.emplace_back("the order of the settings");
    if (lines.size() > most) {
        const std::size_t more = lines.size() - most;
        lines.resize(most);
        lines.push_back(fmt::format("and {} more", more));
    }
    return lines;
}

}  // namespace strata::journal
