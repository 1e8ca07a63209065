#include "tests/golden/reference_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/binary_from_base64.hpp>
#include <boost/archive/iterators/dataflow_exception.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <span>
#include <sstream>

#include "src/image/canvas.h"
#include "src/image/difference.h"
#include "src/image/image_error.h"
#include "src/image/srgb.h"
#include "src/image/write.h"
#include "tests/golden/digest.h"
#include "tests/golden/pins.h"

namespace strata::golden {

namespace {

namespace iterators = boost::archive::iterators;
using Encode = iterators::base64_from_binary<iterators::transform_width<const std::uint8_t*, 6, 8>>;
using Decode = iterators::transform_width<iterators::binary_from_base64<const char*>, 8, 6>;

constexpr int kBytesAPixel = 4;
constexpr int kZoom = 8;  // a picture of 40 pixels is hard to look at

// Changed bits where all codes agree: a colour that the scale of differences does not have.
constexpr image::Colour kBitsAlone{0.0f, 0.45f, 0.9f};

// Three bytes are four letters: rows are filled up with zeros, and no letter stands for less than its six bits.
std::size_t filled_up(std::size_t bytes) { return (bytes + 2) / 3 * 3; }

std::string encode_row(std::span<const std::uint8_t> row) {
    std::vector<std::uint8_t> bytes(row.begin(), row.end());
    bytes.resize(filled_up(row.size()));
    return {Encode(bytes.data()), Encode(bytes.data() + bytes.size())};
}

std::vector<std::uint8_t> decode_row(const std::string& letters, std::size_t bytes) {
    if (letters.size() != filled_up(bytes) / 3 * 4) throw PinError("a row is too long or too short");
    std::vector<std::uint8_t> row;
    try {
        row.assign(Decode(letters.data()), Decode(letters.data() + letters.size()));
    } catch (const iterators::dataflow_exception&) {
        throw PinError("a row is not base64");
    }
    row.resize(bytes);
    return row;
}

ReferencePicture read_rows(std::istream& text) {
    ReferencePicture reference;
    std::string letters;
    if (!(text >> reference.width >> reference.height) || reference.width < 1 || reference.height < 1) {
        throw PinError("WIDTH HEIGHT is missing");
    }
    for (int y = 0; y < reference.height; ++y) {
        if (!(text >> letters)) throw PinError("rows are missing");
        const auto row = decode_row(letters, static_cast<std::size_t>(reference.width) * kBytesAPixel);
        reference.bytes.insert(reference.bytes.end(), row.begin(), row.end());
    }
    if (text >> letters) throw PinError("there are too many rows");
    return reference;
}

std::size_t pixels_of(const ReferencePicture& reference) { return reference.bytes.size() / kBytesAPixel; }

bool same_codes(const ReferencePicture& a, const ReferencePicture& b, std::size_t pixel) {
    const auto first = static_cast<std::ptrdiff_t>(pixel) * kBytesAPixel;
    return std::equal(a.bytes.begin() + first, a.bytes.begin() + first + 3, b.bytes.begin() + first);
}

image::Picture linear_picture(const ReferencePicture& reference) {
    image::Picture picture = image::make_picture(reference.width, reference.height);
    for (std::size_t i = 0; i < pixels_of(reference); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            picture.rgb[3 * i + c] =
                static_cast<float>(image::decode_srgb(reference.bytes[kBytesAPixel * i + c] / 255.0));
        }
    }
    return picture;
}

// On a scale of one where codes differ.
image::Canvas draw_change(const ReferencePicture& expected, const ReferencePicture& got) {
    const image::Picture from = linear_picture(expected), to = linear_picture(got);
    double largest = 0.0;
    for (std::size_t i = 0; i < from.rgb.size(); ++i) {
        largest = std::max(largest, std::abs(static_cast<double>(from.rgb[i]) - to.rgb[i]));
    }
    image::Canvas canvas = image::difference(to, from, image::scale_top(largest));
    for (std::size_t i = 0; i < pixels_of(expected); ++i) {
        if (!same_codes(expected, got, i) || expected.bytes[kBytesAPixel * i + 3] == got.bytes[kBytesAPixel * i + 3]) {
            continue;
        }
        const int x = static_cast<int>(i) % expected.width, y = static_cast<int>(i) / expected.width;
        image::fill(canvas, {x, y, x + 1, y + 1}, kBitsAlone);
    }
    return canvas;
}

}  // namespace

ReferencePicture reference_of(const image::Picture& picture) {
    const image::Canvas codes = image::to_canvas(picture);
    ReferencePicture reference{picture.width(), picture.height(), {}};
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            reference.bytes.push_back(static_cast<std::uint8_t>(std::lround(255.0f * codes.rgb[3 * i + c])));
        }
        const std::uint64_t bits = digest(std::span<const float>(picture.rgb).subspan(3 * i, 3));
        reference.bytes.push_back(static_cast<std::uint8_t>(bits));
    }
    return reference;
}

std::string print_reference(const ReferencePicture& reference) {
    const std::size_t row = static_cast<std::size_t>(reference.width) * kBytesAPixel;
    std::string text = fmt::format("{} {}\n", reference.width, reference.height);
    for (std::size_t first = 0; first < reference.bytes.size(); first += row) {
        text += encode_row(std::span(reference.bytes).subspan(first, row)) + "\n";
    }
    return text;
}

ReferencePicture parse_reference(const std::string& text, const std::string& source_name) {
    std::istringstream lines(text);
    try {
        return read_rows(lines);
    } catch (const PinError& error) {
        throw PinError(source_name + ": " + error.what());
    }
}

ReferencePicture load_reference(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::ostringstream text;
    if (!file || !(text << file.rdbuf()))
        throw PinError("cannot read " + path.string() + "; tests/golden/pin makes it");
    return parse_reference(text.str(), path.string());
}

PictureChange change_between(const ReferencePicture& expected, const ReferencePicture& got) {
    PictureChange change;
    for (std::size_t i = 0; i < pixels_of(expected); ++i) {
        bool changed = false;
        for (std::size_t c = 0; c < kBytesAPixel; ++c) {
            const int by = std::abs(expected.bytes[kBytesAPixel * i + c] - got.bytes[kBytesAPixel * i + c]);
            changed = changed || by != 0;
            if (c < 3) change.largest_code = std::max(change.largest_code, by);
        }
        change.pixels += changed;
    }
    return change;
}

std::string leave_pictures(const std::filesystem::path& folder, const image::Picture& render,
                           const ReferencePicture& expected) {
    std::filesystem::create_directories(folder);
    image::write_canvas(folder / "expected.png", image::magnify(image::to_canvas(linear_picture(expected)), kZoom));
    try {
        image::WriteOptions options;
        options.exr_format = image::ExrFormat::floating;
        image::write_picture(folder / "render.exr", render, {}, options);
        const ReferencePicture got = reference_of(render);
        if (got.width != expected.width || got.height != expected.height) return "the picture has another size";
        image::write_canvas(folder / "difference.png", image::magnify(draw_change(expected, got), kZoom));
        const PictureChange change = change_between(expected, got);
        return fmt::format("{} of {} pixels differ from the expected picture, by {} of 255 at most", change.pixels,
                           render.pixels(), change.largest_code);
    } catch (const image::ImageError& error) {
        return error.what();
    }
}

}  // namespace strata::golden
