#include "tools/job/kept_samples.h"

#include <algorithm>
#include <cmath>

#include "src/film/tiles.h"
#include "src/image/samples.h"
#include "tools/job/film_channels.h"

namespace strata::tools::job {
namespace {

std::span<const float> colour_of(const film::Film& film) { return {&film.pixels()[0].x, 3 * film.pixels().size()}; }

std::vector<float> colour_of(const film::Film& film, std::span<const film::Rect> rects) {
    return journal::gather(colour_of(film), 3, film.window(), rects);
}

std::vector<std::uint8_t> dithered(const film::Film& film, std::span<const film::Rect> rects,
                                   const image::ColourOut& colour) {
    std::vector<std::uint8_t> codes;
    for (const film::Rect& rect : rects) {
        const std::vector<float> linear = colour_of(film, {&rect, 1});
        const auto part = image::codes_of_8_bits(linear, colour, rect.x0, rect.y0, rect.width());
        codes.insert(codes.end(), part.begin(), part.end());
    }
    return codes;
}

bool is_keepable(const film::Film& film, const film::Rect& rect) {
    bool all = true;
    journal::for_each_row(film.window(), {&rect, 1}, [&](std::size_t in_film, std::size_t, std::size_t pixels) {
        const auto row = colour_of(film).subspan(3 * in_film, 3 * pixels);
        // Not a number is not below it either.
        all &= std::ranges::all_of(row, [](float value) { return std::fabs(value) <= image::kMaxHalf; });
    });
    return all;
}

}  // namespace

std::vector<SampleKind> kept_kinds(std::span<const std::filesystem::path> outputs, image::ExrFormat exr_format,
                                   bool has_channels) {
    const auto any = [&](auto... formats) {
        return std::ranges::any_of(outputs, [&](const std::filesystem::path& path) {
            const image::Format format = image::format_of(path);
            return ((format == formats) || ...);
        });
    };
    std::vector<SampleKind> kinds;
    if (any(image::Format::exr) && exr_format == image::ExrFormat::floating) {
        kinds = {SampleKind::floats};
    } else {
        if (any(image::Format::exr)) kinds.push_back(SampleKind::halves);
        if (any(image::Format::png, image::Format::jpeg)) kinds.push_back(SampleKind::codes_8);
        if (any(image::Format::tiff)) kinds.push_back(SampleKind::codes_16);
    }
    if (has_channels) kinds.push_back(SampleKind::channels);
    return kinds;
}

std::optional<SampleKind> codes_of(image::Format format) {
    if (format == image::Format::exr) return std::nullopt;
    return format == image::Format::tiff ? SampleKind::codes_16 : SampleKind::codes_8;
}

journal::SampleLayout layout_of(SampleKind kind, std::size_t channel_values) {
    switch (kind) {
        case SampleKind::codes_8:
            return {3, 1};
        case SampleKind::halves:
        case SampleKind::codes_16:
            return {3, 2};
        case SampleKind::floats:
            return {3, 4};
        case SampleKind::channels:
            break;
    }
    return {static_cast<std::uint32_t>(channel_values), 4};
}

journal::PixelPart samples_of(SampleKind kind, const film::Film& film, std::span<const film::Rect> rects,
                              const image::ColourOut& colour) {
    const std::size_t values = channel_values(film);
    const journal::SampleLayout layout = layout_of(kind, values);
    switch (kind) {
        case SampleKind::codes_8:
            return part_of(layout, dithered(film, rects, colour));
        case SampleKind::codes_16:
            return part_of(layout, image::codes_of_16_bits(colour_of(film, rects), colour));
        case SampleKind::halves:
            return part_of(layout, image::halves(colour_of(film, rects)));
        case SampleKind::floats:
            return part_of(layout, colour_of(film, rects));
        case SampleKind::channels:
            break;
    }
    return part_of(layout, journal::gather(channels_of(film), values, film.window(), rects));
}

std::vector<film::Rect> keepable(const film::Film& film, std::span<const film::Rect> rects) {
    constexpr int kBlock = 64;
    std::vector<film::Rect> result;
    for (const film::Rect& rect : rects) {
        if (is_keepable(film, rect)) {
            result.push_back(rect);
            continue;
        }
        const film::TileGrid blocks(rect, kBlock);
        for (std::int64_t i = 0; i < blocks.count(); ++i) {
            const film::Rect block = blocks.tile(i);
            if (is_keepable(film, block)) result.push_back(block);
        }
    }
    return result;
}

}  // namespace strata::tools::job
