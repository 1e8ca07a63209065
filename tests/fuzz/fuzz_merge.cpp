// Two files of any bytes as the parts of a picture: they are put together, or refused before anything is written.
// The first four bytes say how long the first one is. Digests are put right.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include "src/image/digest.h"
#include "src/image/image_error.h"
#include "src/image/library.h"
#include "src/scene/scene_error.h"
#include "tests/fuzz/scratch_file.h"
#include "tools/cli/errors.h"
#include "tools/merge/whole.h"

namespace {

std::vector<unsigned char> part(const std::uint8_t* data, std::size_t size) {
    std::vector<unsigned char> bytes(data, data + size);
    try {
        strata::image::put_digest(strata::image::Format::exr, bytes);
    } catch (const strata::image::ImageError&) {
    }
    return bytes;
}

void merge(const std::vector<std::string>& files, const std::filesystem::path& whole) {
    const strata::tools::merge::Parts parts = strata::tools::merge::find_parts(files);
    strata::tools::merge::write_whole(
        parts, whole, [](double) {}, [](const std::string&) {});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    strata::image::configure_library();
    std::uint32_t first = 0;
    if (size < sizeof first) return 0;
    std::memcpy(&first, data, sizeof first);
    data += sizeof first, size -= sizeof first;
    if (first > size) return 0;
    const strata::fuzz::ScratchFile one(part(data, first), "-1.exr"), two(part(data + first, size - first), "-2.exr");
    const std::filesystem::path whole = strata::fuzz::ScratchFile::folder() / "whole.exr";
    try {
        merge({one.path().string(), two.path().string()}, whole);
        if (!std::filesystem::remove(whole)) std::abort();
    } catch (const strata::scene::SceneError&) {
    } catch (const strata::image::ImageError&) {
    } catch (const strata::tools::cli::UsageError&) {
    }
    if (std::filesystem::exists(whole)) std::abort();
    return 0;
}
