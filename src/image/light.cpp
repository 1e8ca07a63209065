#include "src/image/light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "src/image/icc_curve.h"
#include "src/image/image_error.h"
#include "src/image/png_chunks.h"
#include "src/image/srgb.h"

namespace strata::image {
namespace {

// Transfer characteristics of ITU-T H.273.
constexpr unsigned kGamma22 = 4, kGamma28 = 5, kLinear = 8, kPq = 16, kHlg = 18;

Transfer power_curve(double power) {
    // 2.2 is what files of sRGB say that have room for one number only.
    if (std::abs(power - 2.2) < 0.005) return {};
    if (std::abs(power - 1.0) < 0.005) return {Transfer::Curve::linear, 1.0};
    return {Transfer::Curve::power, power};
}

std::optional<Transfer> transfer_of_cicp(const std::filesystem::path& path) {
    const std::optional<std::string> chunk = find_png_chunk(path, "cICP");
    if (!chunk || chunk->size() != 4) return std::nullopt;
    switch (static_cast<unsigned char>((*chunk)[1])) {
        case kLinear:
            return power_curve(1.0);
        case kGamma22:
            return power_curve(2.2);
        case kGamma28:
            return power_curve(2.8);
        case kPq:
        case kHlg:
            throw ImageError(fmt::format(
                "cannot read \"{}\": its values are those of high dynamic range video (PQ or HLG); allowed: linear, "
                "sRGB, or a power",
                path.string()));
        default:
            return Transfer{};
    }
}

std::optional<double> icc_power(const OIIO::ImageSpec& spec) {
    const OIIO::ParamValue* profile = spec.find_attribute("ICCProfile");
    if (profile == nullptr || profile->type().basetype != OIIO::TypeDesc::UINT8) return std::nullopt;
    return power_of_icc({static_cast<const unsigned char*>(profile->data()), profile->type().size()});
}

int channel_of(const OIIO::ImageSpec& spec, std::string_view name) {
    const auto found = std::ranges::find(spec.channelnames, name);
    return found == spec.channelnames.end() ? -1 : static_cast<int>(found - spec.channelnames.begin());
}

}  // namespace

double Transfer::decode(double value) const {
    switch (curve) {
        case Curve::linear:
            return value;
        case Curve::power:
            return std::copysign(std::pow(std::abs(value), power), value);
        case Curve::srgb:
            break;
    }
    return decode_srgb(value);
}

Transfer transfer_of(const std::filesystem::path& path, Format format, const OIIO::ImageSpec& spec) {
    if (format == Format::exr || spec.format.is_floating_point()) return power_curve(1.0);
    if (format == Format::png) {
        if (const auto transfer = transfer_of_cicp(path)) return *transfer;
    }
    if (spec.find_attribute("ICCProfile") != nullptr) {
        const auto power = icc_power(spec);
        return power ? power_curve(*power) : Transfer{};
    }
    const std::string space = spec.get_string_attribute("oiio:ColorSpace").str();
    if (space == "Linear") return power_curve(1.0);
    if (space.starts_with("GammaCorrected")) return power_curve(spec.get_float_attribute("oiio:Gamma", 2.2f));
    return {};
}

int ColourChannels::begin() const {
    const int first = *std::ranges::min_element(rgb);
    return alpha < 0 ? first : std::min(first, alpha);
}

int ColourChannels::end() const { return std::max(*std::ranges::max_element(rgb), alpha) + 1; }

ColourChannels colour_channels(const std::filesystem::path& path, const OIIO::ImageSpec& spec) {
    ColourChannels channels;
    const int grey = channel_of(spec, "Y");
    const std::array<int, 3> named{channel_of(spec, "R"), channel_of(spec, "G"), channel_of(spec, "B")};
    const int colours = spec.nchannels - (spec.alpha_channel >= 0 && spec.nchannels > 1 ? 1 : 0);
    if (std::ranges::min(named) >= 0) {
        channels.rgb = named;
    } else if (grey >= 0 && channel_of(spec, "RY") < 0 && channel_of(spec, "BY") < 0) {
        channels.rgb = {grey, grey, grey};
    } else if (colours == 1) {
        const int first = spec.alpha_channel == 0 && spec.nchannels > 1 ? 1 : 0;
        channels.rgb = {first, first, first};
    } else if (colours == 2 || grey >= 0) {
        throw ImageError(
            fmt::format("cannot read \"{}\": its channels are {}; allowed: grey or RGB, each with alpha or without",
                        path.string(), fmt::join(spec.channelnames, ", ")));
    }
    const bool is_colour = std::ranges::find(channels.rgb, spec.alpha_channel) != channels.rgb.end();
    if (spec.alpha_channel >= 0 && !is_colour) channels.alpha = spec.alpha_channel;
    channels.is_associated = spec.get_int_attribute("oiio:UnassociatedAlpha") == 0;
    return channels;
}

double light_over_black(const Transfer& transfer, double value, double alpha, bool is_associated) {
    if (transfer.curve == Transfer::Curve::linear) return is_associated ? value : value * alpha;
    if (!is_associated) return transfer.decode(value) * alpha;
    // Codes are multiplied by alpha as they are, before the curve that is to be undone.
    return alpha > 0 ? transfer.decode(std::min(1.0, value / alpha)) * alpha : 0.0;
}

}  // namespace strata::image
