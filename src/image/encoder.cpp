#include "src/image/encoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "src/image/colour_out.h"
#include "src/image/image_error.h"
#include "src/image/library.h"
#include "src/image/library_noise.h"
#include "src/image/picture_spec.h"
#include "src/image/png_text.h"
#include "src/image/samples.h"

namespace strata::image {
namespace {

void check_shape(const std::filesystem::path& path, const PictureShape& p) {
    const bool inside =
        p.x0 >= 0 && p.y0 >= 0 && p.x0 < p.x1 && p.y0 < p.y1 && p.x1 <= p.frame_width && p.y1 <= p.frame_height;
    if (!inside)
        fail_to_write(path, fmt::format("the crop {},{},{},{} is empty or outside the {}x{} frame", p.x0, p.y0, p.x1,
                                        p.y1, p.frame_width, p.frame_height));
    check_size(path, p.width(), p.height());
}

std::vector<float> clamp_to_half(std::span<const float> linear) {
    std::vector<float> clamped(linear.begin(), linear.end());
    for (float& value : clamped) value = std::clamp(value, -kMaxHalf, kMaxHalf);
    return clamped;
}

// The nearest code of [0, max(Code)] to values that are codes of [0,1].
template <class Code>
std::vector<Code> round_codes(std::span<const float> values) {
    constexpr double kTop = std::numeric_limits<Code>::max();
    std::vector<Code> codes;
    codes.reserve(values.size());
    for (const float v : values) codes.push_back(static_cast<Code>(std::lround(std::clamp<double>(v, 0, 1) * kTop)));
    return codes;
}

}  // namespace

void check_encodable(const std::filesystem::path& path, const PictureShape& shape, const Metadata& metadata,
                     const WriteOptions& options) {
    check_shape(path, shape);
    if (const auto problem = problem_of(options.colour)) fail_to_write(path, *problem);
    make_spec(path, format_of(path), shape, metadata, options);
}

Encoder::Encoder(const std::filesystem::path& path, const PictureShape& shape, const Metadata& metadata,
                 const WriteOptions& options, OIIO::Filesystem::IOProxy& bytes)
    : path_(path), format_(format_of(path)), shape_(shape), options_(options) {
    check_encodable(path, shape, metadata, options);
    configure_library();
    const OIIO::ImageSpec spec = make_spec(path, format_, shape, metadata, options);
    if (format_ == Format::png) with_text_ = add_utf8_text(bytes, metadata);
    output_ = OIIO::ImageOutput::create(name_of(format_));
    if (!output_) fail_to_write(path, OIIO::geterror());
    if (!output_->set_ioproxy(with_text_ ? with_text_.get() : &bytes))
        fail_to_write(path, "OpenImageIO cannot encode this format here");
    const LibraryNoise noise;
    if (!output_->open(name_of(format_), spec)) fail_to_write(path, noise.explain(output_->geterror()));
}

int Encoder::rows_of(std::size_t values) const {
    const auto row = 3 * static_cast<std::size_t>(shape_.width());
    const int rows = static_cast<int>(values / row);
    if (values % row != 0 || rows != std::min(kStripRows, rows_left()))
        fail_to_write(path_,
                      fmt::format("{} values are no strip of {} rows", values, std::min(kStripRows, rows_left())));
    return rows;
}

// A pixel of the rows in work, the one whose first value is `i`: "(12,6) = (nan, 0, 0)".
std::string Encoder::describe(std::span<const float> rgb, std::size_t i) const {
    const auto width = static_cast<std::size_t>(shape_.width());
    return fmt::format("({},{}) = ({}, {}, {})", static_cast<std::size_t>(shape_.x0) + i / 3 % width,
                       static_cast<std::size_t>(shape_.y0 + next_row_) + i / 3 / width, rgb[i], rgb[i + 1], rgb[i + 2]);
}

void Encoder::count_not_finite(std::span<const float> rgb) {
    if (options_.keeps_not_finite && format_ == Format::exr && options_.exr_format == ExrFormat::floating) return;
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
        if (std::isfinite(rgb[i]) && std::isfinite(rgb[i + 1]) && std::isfinite(rgb[i + 2])) continue;
        if (not_finite_++ == 0) first_not_finite_ = describe(rgb, i);
    }
}

void Encoder::count_clipped(std::span<const float> rgb) {
    const auto is_beyond = [](float value) { return std::fabs(value) > kMaxHalf; };
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
        if (std::ranges::none_of(rgb.subspan(i, 3), is_beyond)) continue;
        if (clipped_++ == 0) first_clipped_ = describe(rgb, i);
    }
}

void Encoder::write(OIIO::TypeDesc type, const void* values, int rows) {
    const OIIO::ImageSpec& spec = output_->spec();
    const int y = spec.y + next_row_;
    next_row_ += rows;
    const bool written = spec.tile_width > 0
                             ? output_->write_tiles(spec.x, spec.x + spec.width, y, y + rows, 0, 1, type, values)
                             : output_->write_scanlines(y, y + rows, 0, type, values);
    if (!written) fail_to_write(path_, output_->geterror());
}

void Encoder::write_linear(std::span<const float> rgb, std::span<const float> extra, const CodesHook& on_codes) {
    const int rows = rows_of(rgb.size());
    count_not_finite(rgb);
    const int y = shape_.y0 + next_row_;
    if (not_finite_ > 0) {
        // The file will not be kept, but must become whole; NaN has no code.
        const std::vector<float> black(rgb.size() / 3 * channels(), 0.0f);
        return write(OIIO::TypeDesc::FLOAT, black.data(), rows);
    }
    switch (format_) {
        case Format::exr:
            return write_exr(rgb, extra, rows);
        case Format::tiff:
            return write_coded(codes_of_16_bits(rgb, options_.colour), OIIO::TypeDesc::UINT16, rows, on_codes);
        case Format::png:
        case Format::jpeg:
            return write_coded(codes_of_8_bits(rgb, options_.colour, shape_.x0, y, shape_.width()),
                               OIIO::TypeDesc::UINT8, rows, on_codes);
    }
}

template <class Code>
void Encoder::write_coded(std::vector<Code> codes, OIIO::TypeDesc type, int rows, const CodesHook& on_codes) {
    if (on_codes) on_codes({reinterpret_cast<unsigned char*>(codes.data()), codes.size() * sizeof(Code)});
    write(type, codes.data(), rows);
}

void Encoder::write_exr(std::span<const float> rgb, std::span<const float> extra, int rows) {
    std::vector<float> clamped;
    if (options_.exr_format == ExrFormat::half) {
        count_clipped(rgb);
        rgb = clamped = clamp_to_half(rgb);
    }
    const std::size_t extra_channels = channels() - 3;
    if (extra_channels == 0) return write(OIIO::TypeDesc::FLOAT, rgb.data(), rows);
    if (extra.size() != rgb.size() / 3 * extra_channels)
        fail_to_write(path_, fmt::format("{} values do not make {} channels beside {} pixels", extra.size(),
                                         extra_channels, rgb.size() / 3));
    std::vector<float> all;
    all.reserve(rgb.size() + extra.size());
    for (std::size_t i = 0; i < rgb.size() / 3; ++i) {
        const auto colour = rgb.subspan(3 * i, 3), beside = extra.subspan(extra_channels * i, extra_channels);
        all.insert(all.end(), colour.begin(), colour.end());
        all.insert(all.end(), beside.begin(), beside.end());
    }
    write(OIIO::TypeDesc::FLOAT, all.data(), rows);
}

void Encoder::write_codes(std::span<const float> rgb) {
    const int rows = rows_of(rgb.size());
    count_not_finite(rgb);
    if (not_finite_ > 0) return write_linear(rgb);
    if (format_ == Format::tiff) return write(OIIO::TypeDesc::UINT16, round_codes<std::uint16_t>(rgb).data(), rows);
    write(OIIO::TypeDesc::UINT8, round_codes<std::uint8_t>(rgb).data(), rows);
}

// An EXR gives its channels back in an order of its own.
std::vector<std::size_t> Encoder::places_in(const OIIO::ImageSpec& from) const {
    std::vector<std::size_t> places;
    for (const std::string& name : output_->spec().channelnames) {
        const int place = from.channelindex(name);
        if (place < 0) fail_to_write(path_, fmt::format("the channel {} is lost", name));
        places.push_back(static_cast<std::size_t>(place));
    }
    return places;
}

void Encoder::copy(OIIO::ImageInput& written) {
    const OIIO::ImageSpec& from = written.spec();
    const std::vector<std::size_t> places = format_ == Format::exr ? places_in(from) : std::vector<std::size_t>();
    const bool is_in_order = std::ranges::is_sorted(places);
    std::vector<unsigned char> ordered;
    // Every half is a float.
    const OIIO::TypeDesc type =
        format_ == Format::exr ? OIIO::TypeDesc::FLOAT : pixel_type(format_, options_.exr_format);
    const int chend = static_cast<int>(channels());
    std::vector<unsigned char> strip;
    while (rows_left() > 0) {
        const int rows = std::min(kStripRows, rows_left());
        const int y = from.y + next_row_;
        strip.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(from.width) * channels() * type.size());
        const bool read =
            from.tile_width > 0
                ? written.read_tiles(0, 0, from.x, from.x + from.width, y, y + rows, 0, 1, 0, chend, type, strip.data())
                : written.read_scanlines(0, 0, y, y + rows, 0, 0, chend, type, strip.data());
        if (!read) fail_to_write(path_, written.geterror());
        if (!is_in_order) {
            ordered.resize(strip.size());
            for (std::size_t i = 0; i < strip.size() / type.size(); ++i) {
                const std::size_t value = i - i % places.size() + places[i % places.size()];
                std::copy_n(&strip[value * type.size()], type.size(), &ordered[i * type.size()]);
            }
            strip.swap(ordered);
        }
        write(type, strip.data(), rows);
    }
}

void Encoder::write_rows_left() {
    const auto row = channels() * static_cast<std::size_t>(shape_.width());
    const std::vector<float> black(row * static_cast<std::size_t>(std::min(kStripRows, rows_left())), 0.0f);
    while (rows_left() > 0) {
        const int rows = std::min(kStripRows, rows_left());
        write(OIIO::TypeDesc::FLOAT, black.data(), rows);
    }
}

void Encoder::finish() {
    const LibraryNoise noise;
    if (!output_->close()) fail_to_write(path_, noise.explain(output_->geterror()));
    if (not_finite_ == 0) return;
    fail_to_write(path_, fmt::format("{} pixel{} not finite, first {}", not_finite_, not_finite_ == 1 ? " is" : "s are",
                                     first_not_finite_));
}

std::string Encoder::clipping() const {
    if (clipped_ == 0) return "";
    return fmt::format("{} pixel{} beyond {}, the largest half, {} clipped to it, first {}", clipped_,
                       clipped_ == 1 ? "" : "s", kMaxHalf, clipped_ == 1 ? "is" : "are", first_clipped_);
}

void tell_clipping(const std::filesystem::path& path, const Encoder& encoder, const WriteOptions& options) {
    const std::string clipping = encoder.clipping();
    if (options.warn && !clipping.empty()) options.warn(fmt::format("\"{}\": {}", path.string(), clipping));
}

}  // namespace strata::image
