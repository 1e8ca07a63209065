#include "src/image/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>

#include "src/image/font.h"
#include "src/image/image_error.h"

namespace strata::image {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 3> kFontFolders{
    "/usr/share/fonts/truetype/dejavu",    // Debian
    "/usr/share/fonts/dejavu-sans-fonts",  // Fedora
    "/usr/share/fonts/TTF",                // Arch
};

fs::path font_file(Weight weight) {
    std::vector<fs::path> candidates;
    candidates.reserve(kFontFolders.size());
    for (const char* folder : kFontFolders)
        candidates.push_back(fs::path(folder) / (weight == Weight::bold ? "DejaVuSans-Bold.ttf" : "DejaVuSans.ttf"));
    return find_font(candidates);
}

Font& font_of(const TextStyle& style) {
    // FreeType's faces are for one thread each.
    thread_local Font regular(font_file(Weight::regular)), bold(font_file(Weight::bold));
    Font& font = style.weight == Weight::bold ? bold : regular;
    font.set_size(style.size_px);
    return font;
}

// DejaVu Sans: 0.928 of the size above the baseline, 0.236 below.
constexpr double kAscent = 0.928;
constexpr double kDescent = 0.236;

int ascent(const TextStyle& style) { return static_cast<int>(std::ceil(kAscent * style.size_px)); }

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    for (;;) {
        const std::size_t end = text.find('\n');
        lines.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return lines;
        text.remove_prefix(end + 1);
    }
}

int line_width(std::string_view line, const TextStyle& style) {
    return static_cast<int>(std::ceil(font_of(style).advance_px(line)));
}

// Where UTF-8 characters start, and the end.
std::vector<std::size_t> character_starts(std::string_view text) {
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < text.size(); ++i)
        if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) starts.push_back(i);
    starts.push_back(text.size());
    return starts;
}

// The bytes of as many characters, at least one, as fit.
std::size_t fitting(std::string_view text, int width_px, const TextStyle& style) {
    const std::vector<std::size_t> starts = character_starts(text);
    std::size_t count = 1;
    while (count + 1 < starts.size() && line_width(text.substr(0, starts[count + 1]), style) <= width_px) ++count;
    return starts[std::min(count, starts.size() - 1)];
}

// The blank where a line may end: "m = 4" stays together.
std::size_t find_break(std::string_view line) {
    std::size_t at = line.find(' ');
    while (at != std::string_view::npos && (line.substr(at + 1, 1) == "=" || (at > 0 && line[at - 1] == '=')))
        at = line.find(' ', at + 1);
    return std::min(at, line.size());
}

void wrap_line(std::string_view line, int width_px, const TextStyle& style, std::string& wrapped) {
    std::string current;
    while (!line.empty()) {
        const std::size_t end = find_break(line);
        std::string_view word = line.substr(0, end);
        line.remove_prefix(std::min(line.size(), end + 1));
        std::string longer = current.empty() ? std::string(word) : fmt::format("{} {}", current, word);
        if (line_width(longer, style) <= width_px) {
            current = std::move(longer);
            continue;
        }
        if (!current.empty()) wrapped += current + "\n";
        while (line_width(word, style) > width_px && character_starts(word).size() > 2) {
            const std::size_t part = fitting(word, width_px, style);
            wrapped.append(word.substr(0, part)) += '\n';
            word.remove_prefix(part);
        }
        current = word;
    }
    wrapped += current;
}

}  // namespace

fs::path find_font(std::span<const fs::path> candidates) {
    for (const fs::path& path : candidates) {
        std::error_code error;
        if (fs::is_regular_file(path, error)) return path;
    }
    throw ImageError(
        fmt::format("the font for labels is not there: Debian has it in the package fonts-dejavu-core (looked for {})",
                    candidates.empty() ? "" : candidates.front().string()));
}

void check_fonts() {
    font_file(Weight::regular);
    font_file(Weight::bold);
}

int line_height(const TextStyle& style) {
    constexpr int kHinting = 1;  // fitting strokes to rows lowers some
    return ascent(style) + static_cast<int>(std::ceil(kDescent * style.size_px)) + kHinting;
}

int line_count(std::string_view text) { return static_cast<int>(std::ranges::count(text, '\n')) + 1; }

int text_width(std::string_view text, const TextStyle& style) {
    int width = 0;
    for (const std::string_view line : lines_of(text)) width = std::max(width, line_width(line, style));
    return width;
}

int draw_text(Canvas& canvas, int x, int y, std::string_view text, const TextStyle& style) {
    const int height = line_height(style);
    int top = y;
    for (const std::string_view line : lines_of(text)) {
        const int width = style.anchor == Anchor::left ? 0 : line_width(line, style);
        const int left = style.anchor == Anchor::left ? x : style.anchor == Anchor::right ? x - width : x - width / 2;
        font_of(style).draw(canvas, left, top + ascent(style), line, style.colour);
        top += height;
    }
    return top - y;
}

std::string wrap(std::string_view text, int width_px, const TextStyle& style) {
    std::string wrapped;
    bool first = true;
    for (const std::string_view line : lines_of(text)) {
        if (!first) wrapped += '\n';
        first = false;
        wrap_line(line, width_px, style, wrapped);
    }
    return wrapped;
}

}  // namespace strata::image
