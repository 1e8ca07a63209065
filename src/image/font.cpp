#include "src/image/font.h"

#include <fmt/format.h>
#include <ft2build.h>

#include <algorithm>

#include "src/image/image_error.h"
#include FT_FREETYPE_H
#include FT_OUTLINE_H

namespace strata::image {
namespace {

constexpr char32_t kReplacement = 0xfffd;
constexpr FT_Pos kPixel = 64;  // FreeType counts positions in 26.6 fixed point

// Vertical hinting alone: strokes keep their distances along the line.
constexpr FT_Int32 kLoadFlags = FT_LOAD_NO_BITMAP | FT_LOAD_TARGET_LIGHT;

void blend(Canvas& canvas, int x, int y, float coverage, const Colour& colour) {
    if (x < 0 || y < 0 || x >= canvas.width || y >= canvas.height) return;
    float* rgb = &canvas.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(canvas.width) +
                                  static_cast<std::size_t>(x))];
    rgb[0] += coverage * (colour.r - rgb[0]);
    rgb[1] += coverage * (colour.g - rgb[1]);
    rgb[2] += coverage * (colour.b - rgb[2]);
}

void blend(Canvas& canvas, int left, int top, const FT_Bitmap& bitmap, const Colour& colour) {
    for (unsigned row = 0; row < bitmap.rows; ++row) {
        const unsigned char* coverage = bitmap.buffer + static_cast<std::ptrdiff_t>(row) * bitmap.pitch;
        for (unsigned column = 0; column < bitmap.width; ++column) {
            if (coverage[column] == 0) continue;
            blend(canvas, left + static_cast<int>(column), top + static_cast<int>(row),
                  static_cast<float>(coverage[column]) / 255.0f, colour);
        }
    }
}

}  // namespace

struct Font::Face {
    FT_Library library = nullptr;
    FT_Face face = nullptr;

    ~Face() {
        if (face != nullptr) FT_Done_Face(face);
        if (library != nullptr) FT_Done_FreeType(library);
    }

    // Calls visit(pen) with each glyph loaded, pen its position in 26.6; returns where the pen ends.
    template <class Visit>
    FT_Pos walk(std::string_view line, const Visit& visit) {
        FT_Pos pen = 0;
        FT_UInt previous = 0;
        while (!line.empty()) {
            const FT_UInt glyph = FT_Get_Char_Index(face, take_code_point(line));
            FT_Vector kerning{};
            if (previous != 0 && FT_Get_Kerning(face, previous, glyph, FT_KERNING_UNFITTED, &kerning) == 0)
                pen += kerning.x;
            if (FT_Load_Glyph(face, glyph, kLoadFlags) != 0) continue;
            visit(pen);
            pen += face->glyph->linearHoriAdvance >> 10;  // 16.16
            previous = glyph;
        }
        return pen;
    }
};

Font::Font(const std::filesystem::path& path) : face_(std::make_unique<Face>()) {
    const bool loaded = FT_Init_FreeType(&face_->library) == 0 &&
                        FT_New_Face(face_->library, path.c_str(), 0, &face_->face) == 0 && FT_IS_SCALABLE(face_->face);
    if (!loaded) throw ImageError(fmt::format("cannot read \"{}\": no font of outlines", path.string()));
}

Font::~Font() = default;

void Font::set_size(int size_px) {
    if (FT_Set_Pixel_Sizes(face_->face, 0, static_cast<FT_UInt>(size_px)) != 0)
        throw ImageError(fmt::format("the font has no size of {} pixels", size_px));
}

double Font::advance_px(std::string_view line) {
    return static_cast<double>(face_->walk(line, [](FT_Pos) {})) / kPixel;
}

void Font::draw(Canvas& canvas, int x, int baseline, std::string_view line, const Colour& colour) {
    face_->walk(line, [&](FT_Pos pen) {
        const FT_GlyphSlot slot = face_->face->glyph;
        const FT_Pos whole = pen >> 6;
        FT_Outline_Translate(&slot->outline, pen - whole * kPixel, 0);
        if (FT_Render_Glyph(slot, FT_RENDER_MODE_NORMAL) != 0) return;
        blend(canvas, x + static_cast<int>(whole) + slot->bitmap_left, baseline - slot->bitmap_top, slot->bitmap,
              colour);
    });
}

char32_t take_code_point(std::string_view& text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(0);
    const std::size_t length = first < 0x80                    ? 1
                               : first >= 0xc2 && first < 0xe0 ? 2
                               : (first & 0xf0) == 0xe0        ? 3
                               : first >= 0xf0 && first < 0xf5 ? 4
                                                               : 0;
    char32_t code = length == 1 ? first : first & (0x7fu >> length);
    bool valid = length > 0 && length <= text.size();
    for (std::size_t i = 1; valid && i < length; ++i) {
        valid = (byte(i) & 0xc0) == 0x80;
        code = code << 6 | (byte(i) & 0x3fu);
    }
    // Overlong forms, surrogates and what lies beyond Unicode are no code points; control characters have no glyph.
    constexpr char32_t kLeast[] = {0, 0x20, 0x80, 0x800, 0x10000};
    valid = valid && code >= kLeast[length] && !(code >= 0xd800 && code < 0xe000) && code <= 0x10ffff;
    text.remove_prefix(valid ? length : 1);
    return valid ? code : kReplacement;
}

}  // namespace strata::image
