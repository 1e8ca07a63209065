// What a journal keeps of a picture's pixels: what its files will hold of them, and no more.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "src/film/film.h"
#include "src/image/encode.h"
#include "src/image/format.h"
#include "src/journal/pixel_record.h"

namespace strata::tools::job {

// All but `channels` are of the colour. Codes are made of the colour by the encoders, and cannot be made again of
// halves.
enum class SampleKind { halves, floats, codes_8, codes_16, channels };

// The kinds that these files need, in the order of a record's parts: floats serve for all; otherwise halves for an EXR,
// and codes for the other formats. Channels if there are any.
std::vector<SampleKind> kept_kinds(std::span<const std::filesystem::path> outputs, image::ExrFormat exr_format,
                                   bool has_channels);

// The kind of codes that an encoder of this format makes; nothing for EXR.
std::optional<SampleKind> codes_of(image::Format format);

journal::SampleLayout layout_of(SampleKind kind, std::size_t channel_values);

// Parts of `rects` of a film, whose other pixels may be in work; codes are made of its colour.
journal::PixelPart samples_of(SampleKind kind, const film::Film& film, std::span<const film::Rect> rects,
                              const image::ColourOut& colour);

// Rectangles whose pixels come back from the journal as they went in, cut out of `rects` in blocks: an encoder counts
// pixels that are not finite or beyond the largest half, so that those are to be rendered again.
std::vector<film::Rect> keepable(const film::Film& film, std::span<const film::Rect> rects);

}  // namespace strata::tools::job
