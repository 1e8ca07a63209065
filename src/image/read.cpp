#include "src/image/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "src/image/deflate_check.h"
#include "src/image/format.h"
#include "src/image/image_error.h"
#include "src/image/library.h"
#include "src/image/library_noise.h"
#include "src/image/light.h"
#include "src/image/metadata.h"
#include "src/image/openimageio.h"

namespace strata::image {
namespace fs = std::filesystem;
namespace {

struct Signature {
    std::string_view bytes;
    Format format;
};

using namespace std::string_view_literals;
constexpr std::array<Signature, 5> kSignatures{{
    {"\x76\x2f\x31\x01"sv, Format::exr},
    {"\x89PNG\r\n\x1a\n"sv, Format::png},
    {"II*\0"sv, Format::tiff},
    {"MM\0*"sv, Format::tiff},
    {"\xff\xd8\xff"sv, Format::jpeg},
}};

std::optional<Format> sniff(const fs::path& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return std::nullopt;
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::array<char, 8> buffer{};
    file.read(buffer.data(), buffer.size());
    if (file.bad()) fail_to_read(path, std::generic_category().message(errno != 0 ? errno : EIO));
    const std::string_view start(buffer.data(), static_cast<std::size_t>(file.gcount()));
    for (const Signature& signature : kSignatures)
        if (start.starts_with(signature.bytes)) return signature.format;
    return std::nullopt;
}

void check_readable(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) fail_to_read(path, "it does not exist");
    if (error) fail_to_read(path, error.message());
    if (fs::is_directory(status)) fail_to_read(path, "it is a folder");
    errno = 0;
    if (std::ifstream(path)) return;
    fail_to_read(path, errno == 0 || errno == EACCES ? "it may not be read" : std::generic_category().message(errno));
}

struct OpenPicture {
    std::unique_ptr<LibraryNoise> noise;  // until the file is closed
    Format format = Format::exr;
    std::unique_ptr<OIIO::ImageInput> input;
    OIIO::ImageSpec spec;
};

OpenPicture open_picture(const fs::path& path) {
    check_readable(path);
    const std::optional<Format> format = sniff(path);
    if (!format) fail_to_read(path, "it is no EXR, PNG, TIFF or JPEG picture");
    configure_library();
    OpenPicture opened{std::make_unique<LibraryNoise>(), *format, OIIO::ImageInput::create(name_of(*format)), {}};
    if (!opened.input) fail_to_read(path, OIIO::geterror());
    OIIO::ImageSpec request;
    request.attribute("oiio:UnassociatedAlpha", 1);  // OpenImageIO would multiply codes, not light
    if (!opened.input->open(path.string(), opened.spec, request))
        fail_to_read(path, opened.noise->explain(opened.input->geterror()));
    return opened;
}

PictureShape shape_of(Format format, const OIIO::ImageSpec& spec) {
    if (format == Format::png || format == Format::jpeg)
        return {spec.width, spec.height, 0, 0, spec.width, spec.height};
    const int x0 = spec.x - spec.full_x;
    const int y0 = spec.y - spec.full_y;
    return {spec.full_width, spec.full_height, x0, y0, x0 + spec.width, y0 + spec.height};
}

Picture make_window(Format format, const OIIO::ImageSpec& spec) {
    const PictureShape s = shape_of(format, spec);
    Picture picture{s.frame_width, s.frame_height, s.x0, s.y0, s.x1, s.y1, {}};
    picture.rgb.resize(3 * picture.pixels());
    return picture;
}

Metadata metadata_of(const OpenPicture& opened) {
    if (opened.format == Format::tiff || opened.format == Format::jpeg)
        return unpack(opened.spec.get_string_attribute("ImageDescription").str());
    Metadata metadata;
    for (const OIIO::ParamValue& value : opened.spec.extra_attribs) {
        if (value.type() != OIIO::TypeDesc::STRING) continue;
        const std::string text = value.get_string(0);
        if (Metadata::allows(value.name().string(), text)) metadata.set(value.name().string(), text);
    }
    return metadata;
}

// A file of another length than its digest tells is one that another program has written, or is cut, which decoding
// finds.
void refuse_damaged(const fs::path& path, const OpenPicture& opened) {
    const Integrity integrity = check_digest(path, opened.format, metadata_of(opened).find(kDigestKey));
    if (integrity == Integrity::damaged) fail_to_read(path, "it is damaged: its bytes are not those that were written");
    if (integrity == Integrity::whole || opened.format != Format::tiff) return;
    if (const auto damage = find_deflate_damage(path)) fail_to_read(path, *damage);
}

struct StoredPicture {
    Picture picture;
    std::vector<float> alpha;  // empty where there is none
};

// Values as they are in the file, grey in all three channels.
StoredPicture read_stored(const fs::path& path, const OpenPicture& opened, const ColourChannels& channels) {
    StoredPicture stored{make_window(opened.format, opened.spec), {}};
    std::vector<float>& rgb = stored.picture.rgb;
    const int begin = channels.begin(), end = channels.end();
    const bool is_plain = channels.alpha < 0 && channels.rgb == std::array{begin, begin + 1, begin + 2};
    const auto count = static_cast<std::size_t>(end - begin);
    std::vector<float> all(is_plain ? 0 : stored.picture.pixels() * count);
    float* const target = is_plain ? rgb.data() : all.data();
    // OpenImageIO 2.4 "reads" them as zeros.
    if (opened.format == Format::tiff && opened.spec.format == OIIO::TypeDesc::DOUBLE)
        fail_to_read(path, "its values are floating point of 64 bits; allowed: 16 or 32, or whole numbers");
    // A TIFF that lacks strips is "read", with an error pending.
    const bool done = opened.input->read_image(0, 0, begin, end, OIIO::TypeDesc::FLOAT, target);
    if (!done || opened.input->has_error()) fail_to_read(path, opened.noise->explain(opened.input->geterror()));
    if (is_plain) return stored;
    const auto place = [&](int channel) { return static_cast<std::size_t>(channel - begin); };
    for (std::size_t i = 0; i < stored.picture.pixels(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) rgb[3 * i + c] = all[count * i + place(channels.rgb[c])];
        if (channels.alpha >= 0) stored.alpha.push_back(all[count * i + place(channels.alpha)]);
    }
    return stored;
}

}  // namespace

bool is_picture(const fs::path& path) { return sniff(path).has_value(); }

void refuse_damaged(const fs::path& path) { refuse_damaged(path, open_picture(path)); }

PictureFacts read_facts(const fs::path& path) {
    const OpenPicture opened = open_picture(path);
    PictureFacts facts{shape_of(opened.format, opened.spec), {}, Integrity::unknown};
    const Metadata metadata = metadata_of(opened);
    for (const auto& [name, value] : metadata.entries())
        if (name != kDigestKey) facts.metadata.set(name, value);
    facts.integrity = check_digest(path, opened.format, metadata.find(kDigestKey));
    return facts;
}

Picture read_picture(const fs::path& path) {
    const OpenPicture opened = open_picture(path);
    refuse_damaged(path, opened);
    return read_stored(path, opened, colour_channels(path, opened.spec)).picture;
}

Picture read_linear(const fs::path& path, const ColourOut& written_with) {
    const OpenPicture opened = open_picture(path);
    refuse_damaged(path, opened);
    const Transfer transfer = transfer_of(path, opened.format, opened.spec);
    const bool is_linear = transfer.curve == Transfer::Curve::linear;
    const auto obstacle = obstacle_to_light(written_with);
    if (!is_linear && obstacle)
        fail_to_read(
            path, fmt::format("{} is in its codes, which are no linear radiance any more; allowed: the same render as "
                              "EXR, or a PNG, TIFF or JPEG of film.tone none and film.saturation 1",
                              *obstacle));
    const ColourChannels channels = colour_channels(path, opened.spec);
    StoredPicture stored = read_stored(path, opened, channels);
    if (is_linear && (stored.alpha.empty() || channels.is_associated)) return std::move(stored.picture);
    const glm::dvec3 white = is_linear ? glm::dvec3(1.0) : light_of_white(written_with);
    for (std::size_t i = 0; i < stored.picture.rgb.size(); ++i) {
        const double alpha = stored.alpha.empty() ? 1.0 : std::clamp(stored.alpha[i / 3], 0.0f, 1.0f);
        float& value = stored.picture.rgb[i];
        const double light = light_over_black(transfer, value, alpha, channels.is_associated);
        value = static_cast<float>(light * white[static_cast<int>(i % 3)]);
    }
    return std::move(stored.picture);
}

std::optional<std::string> read_metadata(const fs::path& path, std::string_view name) {
    return metadata_of(open_picture(path)).find(name);
}

}  // namespace strata::image
