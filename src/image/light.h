// From the values that a picture file stores to linear light. Private to src/image.
#pragma once

#include <array>
#include <filesystem>

#include "src/image/format.h"
#include "src/image/openimageio.h"

namespace strata::image {

// How stored values stand for light.
struct Transfer {
    enum class Curve { linear, srgb, power };
    Curve curve = Curve::srgb;
    double power = 1.0;  // of Curve::power: light = value^power

    // The light of a value that is finite.
    double decode(double value) const;
};

// EXR and what is stored in floating point is linear. Of whole numbers the file's own word is taken: in a PNG cICP,
// else an ICC profile (of all formats), else gAMA; sRGB where it says nothing, or of a curve that is not known here.
// Throws ImageError, naming `path`, for the curves of high dynamic range video, PQ and HLG.
Transfer transfer_of(const std::filesystem::path& path, Format format, const OIIO::ImageSpec& spec);

// Which channels hold the colour, and what covers it.
struct ColourChannels {
    std::array<int, 3> rgb{0, 1, 2};  // three times the same one of a grey picture
    int alpha = -1;                   // none
    bool is_associated = false;       // the colour is multiplied by alpha already

    int begin() const;
    int end() const;
};

// R, G and B by name, a grey Y, or the first three. Throws ImageError, naming `path`, for channels that are none of
// that.
ColourChannels colour_channels(const std::filesystem::path& path, const OIIO::ImageSpec& spec);

// A colour's value as light over black.
double light_over_black(const Transfer& transfer, double value, double alpha, bool is_associated);

}  // namespace strata::image
