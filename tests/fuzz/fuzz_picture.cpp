// A PNG of any bytes, given as a scene: it says how it was made, or is refused. Checksums and digest are put right, so
// that what was changed is read and not refused for them.
#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/image/digest.h"
#include "src/image/image_error.h"
#include "src/image/library.h"
#include "tests/fuzz/scene_check.h"
#include "tests/fuzz/scratch_file.h"
#include "tools/cli/errors.h"
#include "tools/cli/scene_argument.h"

namespace {

using Bytes = std::vector<unsigned char>;

std::uint32_t number_at(const Bytes& bytes, std::size_t at) {
    return std::uint32_t{bytes[at]} << 24 | std::uint32_t{bytes[at + 1]} << 16 | std::uint32_t{bytes[at + 2]} << 8 |
           bytes[at + 3];
}

// Of all chunks (ISO/IEC 15948, 5.3): length, type, data, CRC-32 of type and data.
void mend_checksums(Bytes& png) {
    for (std::size_t at = 8; at + 12 <= png.size();) {
        const std::size_t length = number_at(png, at);
        if (length > png.size() - at - 12) return;
        const auto check = static_cast<std::uint32_t>(::crc32(0, &png[at + 4], static_cast<unsigned>(length + 4)));
        for (std::size_t i = 0; i < 4; ++i) {
            png[at + 8 + length + i] = static_cast<unsigned char>(check >> (24 - 8 * i));
        }
        at += 12 + length;
    }
}

void load(const std::filesystem::path& path, std::size_t size) {
    namespace cli = strata::tools::cli;
    const cli::LoadedScene loaded = cli::SceneArgument(path.string()).load();
    const strata::film::Rect window = cli::window_of("", loaded);
    if (window.width() < 1 || window.height() < 1 || window.x0 < 0 || window.x1 > loaded.scene.film.width) std::abort();
    cli::tracer_of({}, loaded);
    strata::fuzz::check_scene(loaded.scene, size);
    if (loaded.passes) cli::parse_integer("passes", *loaded.passes, 1, 1000);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    strata::image::configure_library();
    Bytes png(data, data + size);
    mend_checksums(png);
    try {
        strata::image::put_digest(strata::image::Format::png, png);
    } catch (const strata::image::ImageError&) {
    }
    const strata::fuzz::ScratchFile file(png, ".png");
    try {
        load(file.path(), size);
    } catch (const strata::scene::SceneError&) {
    } catch (const strata::image::ImageError&) {
    } catch (const strata::tools::cli::UsageError&) {
    }
    return 0;
}
