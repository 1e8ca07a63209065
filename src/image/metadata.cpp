#include "src/image/metadata.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/image/image_error.h"

namespace strata::image {
namespace {

constexpr std::size_t kMaxName = 79;  // of a PNG keyword
constexpr std::string_view kPrefix = "strata:";
constexpr std::string_view kSeparator = " = ";

bool is_name(std::string_view name) {
    const auto allowed = [](char c) { return c > ' ' && c < 0x7f && c != '='; };
    return name.starts_with(kPrefix) && name.size() > kPrefix.size() && name.size() <= kMaxName &&
           std::ranges::all_of(name, allowed);
}

std::string escape(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '\\')
            escaped += "\\\\";
        else if (c == '\n')
            escaped += "\\n";
        else if (c == '\r')
            escaped += "\\r";
        else
            escaped += c;
    }
    return escaped;
}

std::string unescape(std::string_view text) {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\\' || i + 1 == text.size()) {
            plain += text[i];
            continue;
        }
        const char c = text[++i];
        plain += c == 'n' ? '\n' : c == 'r' ? '\r' : c;
    }
    return plain;
}

}  // namespace

bool Metadata::allows(std::string_view name, std::string_view value) {
    return is_name(name) && value.find('\0') == std::string_view::npos;
}

void Metadata::set(std::string_view name, std::string_view value) {
    if (!is_name(name)) throw ImageError(fmt::format("\"{}\" is no metadata name", name));
    if (value.find('\0') != std::string_view::npos)
        throw ImageError(fmt::format("the metadata \"{}\" holds a NUL character", name));
    const auto entry = std::ranges::find(entries_, name, &Entry::first);
    if (entry != entries_.end())
        entry->second = value;
    else
        entries_.emplace_back(name, value);
}

void Metadata::set(std::string_view name, std::int64_t value) { set(name, fmt::format("{}", value)); }
void Metadata::set(std::string_view name, std::uint64_t value) { set(name, fmt::format("{}", value)); }
void Metadata::set(std::string_view name, double value) { set(name, fmt::format("{}", value)); }

std::optional<std::string> Metadata::find(std::string_view name) const {
    const auto entry = std::ranges::find(entries_, name, &Entry::first);
    if (entry == entries_.end()) return std::nullopt;
    return entry->second;
}

std::string pack(const Metadata& metadata) {
    std::string text;
    for (const auto& [name, value] : metadata.entries()) {
        text += name;
        text += kSeparator;
        text += escape(value);
        text += '\n';
    }
    return text;
}

Metadata unpack(std::string_view text) {
    Metadata metadata;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        const std::size_t split = line.find(kSeparator);
        if (split == std::string_view::npos) continue;
        const std::string value = unescape(line.substr(split + kSeparator.size()));
        if (Metadata::allows(line.substr(0, split), value)) metadata.set(line.substr(0, split), value);
    }
    return metadata;
}

}  // namespace strata::image
