#include "src/image/read.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <memory>

#include "src/image/deflate_check.h"
#include "src/image/format.h"
#include "src/image/image_error.h"
#include "src/image/library.h"
#include "src/image/metadata.h"
#include "src/image/openimageio.h"
#include "src/image/srgb.h"

namespace strata::image {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
    throw ImageError(fmt::format("cannot read \"{}\": {}", path.string(), reason));
}

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
    std::ifstream file(path, std::ios::binary);
    std::array<char, 8> buffer{};
    file.read(buffer.data(), buffer.size());
    const std::string_view start(buffer.data(), static_cast<std::size_t>(file.gcount()));
    for (const Signature& signature : kSignatures)
        if (start.starts_with(signature.bytes)) return signature.format;
    return std::nullopt;
}

void check_readable(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) fail(path, "it does not exist");
    if (error) fail(path, error.message());
    if (fs::is_directory(status)) fail(path, "it is a folder");
    if (!std::ifstream(path)) fail(path, "it may not be read");
}

struct OpenPicture {
    Format format;
    std::unique_ptr<OIIO::ImageInput> input;
    OIIO::ImageSpec spec;
};

OpenPicture open_picture(const fs::path& path) {
    check_readable(path);
    const std::optional<Format> format = sniff(path);
    if (!format) fail(path, "it is no EXR, PNG, TIFF or JPEG picture");
    configure_library();
    OpenPicture opened{*format, OIIO::ImageInput::create(name_of(*format)), {}};
    if (!opened.input) fail(path, OIIO::geterror());
    if (!opened.input->open(path.string(), opened.spec)) fail(path, opened.input->geterror());
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
    if (integrity == Integrity::damaged) fail(path, "it is damaged: its bytes are not those that were written");
    if (integrity == Integrity::whole || opened.format != Format::tiff) return;
    if (const auto damage = find_deflate_damage(path)) fail(path, *damage);
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
    if (opened.spec.nchannels < 3)
        fail(path, fmt::format("it has {} channels, three are needed", opened.spec.nchannels));
    refuse_damaged(path, opened);
    Picture picture = make_window(opened.format, opened.spec);
    // A TIFF that lacks strips is "read", with an error pending.
    const bool done = opened.input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, picture.rgb.data());
    if (!done || opened.input->has_error()) fail(path, opened.input->geterror());
    return picture;
}

Picture read_linear(const fs::path& path, double exposure) {
    Picture picture = read_picture(path);
    if (sniff(path) == Format::exr) return picture;
    const double scale = std::exp2(-exposure);
    for (float& value : picture.rgb) value = static_cast<float>(decode_srgb(value) * scale);
    return picture;
}

std::optional<std::string> read_metadata(const fs::path& path, std::string_view name) {
    return metadata_of(open_picture(path)).find(name);
}

}  // namespace strata::image
