#include "src/image/text.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <codecvt>
#include <locale>
#include <random>
#include <sstream>

#include "src/image/font.h"
#include "src/image/image_error.h"

using namespace strata::image;

namespace {

// The smallest box that holds all that is not paper; empty: none.
Box inked(const Canvas& canvas) {
    Box box{canvas.width, canvas.height, 0, 0};
    for (int y = 0; y < canvas.height; ++y)
        for (int x = 0; x < canvas.width; ++x) {
            const float* rgb = &canvas.rgb[3 * (static_cast<std::size_t>(y) * canvas.width + x)];
            if (rgb[0] == 1 && rgb[1] == 1 && rgb[2] == 1) continue;
            box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1), std::max(box.y1, y + 1)};
        }
    return box;
}

Canvas paper() { return make_canvas(400, 120, house::kPaper); }

std::string without_blanks(std::string text) {
    std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
    return text;
}

std::string random_words(std::mt19937& random) {
    const char* words[] = {"a", "B-spline", "N²", "order", "überlang-zusammengesetzt", "=", "m=4", "μ≤½", ""};
    std::string text;
    const int count = std::uniform_int_distribution(0, 14)(random);
    for (int i = 0; i < count; ++i) {
        if (i > 0) text += std::uniform_int_distribution(0, 9)(random) == 0 ? '\n' : ' ';
        text += words[std::uniform_int_distribution<std::size_t>(0, std::size(words) - 1)(random)];
    }
    return text;
}

}  // namespace

TEST_CASE("text lies where its anchor says, between its top and its height") {
    for (const int size : {house::kNote_px, house::kLabel_px, house::kTitle_px})
        for (const Weight weight : {Weight::regular, Weight::bold})
            for (const char* text : {"Ágjpqy|Ñ", "N = 10, m = 4", "RMSE 0.0123 × 2²"}) {
                TextStyle style{.size_px = size, .weight = weight};
                const int width = text_width(text, style);
                const int left_edges[] = {200, 200 - width / 2, 200 - width};
                for (const Anchor anchor : {Anchor::left, Anchor::centre, Anchor::right}) {
                    style.anchor = anchor;
                    Canvas canvas = paper();
                    const int height = draw_text(canvas, 200, 50, text, style);
                    const Box box = inked(canvas);
                    CHECK(height == line_height(style));
                    CHECK(box.y0 >= 50);
                    CHECK(box.y1 <= 50 + height);
                    const int left = left_edges[static_cast<int>(anchor)];
                    CHECK(box.x0 >= left - 1);
                    CHECK(box.x0 <= left + 3);
                    CHECK(box.x1 <= left + width + 2);
                    CHECK(box.x1 >= left + width - 3);
                }
            }
}

TEST_CASE("lines of a text follow each other at the line height") {
    Canvas one = paper(), two = paper();
    draw_text(one, 10, 10, "HHH");
    const int height = draw_text(two, 10, 10, "HHH\nHHH");
    CHECK(height == 2 * line_height({}));
    CHECK(inked(two).y1 == inked(one).y1 + line_height({}));
    CHECK(inked(two).y0 == inked(one).y0);
}

TEST_CASE("equal texts are equal pixels; text off the canvas is left out") {
    Canvas a = paper(), b = paper(), off = paper();
    draw_text(a, 10, 10, "the same");
    draw_text(b, 10, 10, "the same");
    CHECK(a.rgb == b.rgb);
    draw_text(off, 1000, -500, "elsewhere");
    draw_text(off, -5000, 10, "elsewhere");
    CHECK(off.rgb == paper().rgb);
    CHECK(draw_text(off, 10, 10, "") == line_height({}));
}

TEST_CASE("wrapped text keeps every character and no line is wider than asked, if more than one character") {
    std::mt19937 random(3);
    for (int trial = 0; trial < 150; ++trial) {
        const std::string text = random_words(random);
        const int width = std::uniform_int_distribution(5, 300)(random);
        const std::string wrapped = wrap(text, width, {});
        CHECK(without_blanks(wrapped) == without_blanks(text));
        std::istringstream lines(wrapped);
        for (std::string line; std::getline(lines, line);) {
            const auto characters =
                std::ranges::count_if(line, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
            CHECK_MESSAGE((characters <= 1 || text_width(line, {}) <= width), "'" << line << "' of '" << text << "'");
        }
    }
    CHECK(wrap("one two", 1000, {}) == "one two");
    CHECK(wrap("one\n\ntwo", 1000, {}) == "one\n\ntwo");
}

TEST_CASE("UTF-8 is decoded: every code point comes back, what is none is replaced a byte at a time") {
    for (char32_t code = 0x20; code <= 0x10ffff; code += code < 0x3000 ? 1 : 77) {
        if (code >= 0xd800 && code < 0xe000) continue;
        const std::string bytes = std::wstring_convert<std::codecvt_utf8<char32_t>, char32_t>().to_bytes(code);
        const std::string text = bytes + "z";
        std::string_view rest = text;
        if (take_code_point(rest) != code || rest != "z") FAIL("code point " << static_cast<unsigned>(code));
    }
    for (const std::string bad : {"\x80", "\xff", "\xc0\x80", "\xc3", "\xe2\x89", "\xed\xa0\x80", "\xf5\x80\x80\x80",
                                  "\xf4\x90\x80\x80", "\xe0\x80\x80", "\x07"}) {
        std::string_view rest = bad;
        CHECK(take_code_point(rest) == 0xfffd);
        CHECK(rest.size() == bad.size() - 1);
    }
}

TEST_CASE("characters beyond ASCII have glyphs of their own") {
    const auto drawn = [](std::string_view text) {
        Canvas canvas = paper();
        draw_text(canvas, 10, 10, text);
        return canvas.rgb;
    };
    const char* texts[] = {"²", "2", "×", "≤", "≥", "…", "°", "μ", "½", "ü", "\xff"};
    for (const char* a : texts)
        for (const char* b : texts) CHECK((drawn(a) == drawn(b)) == (a == b));
}

TEST_CASE("a missing font is an error that names the package") {
    CHECK_NOTHROW(check_fonts());
    const std::filesystem::path candidates[] = {"/nowhere/DejaVuSans.ttf"};
    CHECK_THROWS_WITH_AS(find_font(candidates), doctest::Contains("fonts-dejavu-core"), ImageError);
    CHECK_THROWS_AS(find_font({}), ImageError);
}
