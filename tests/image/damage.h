// Files as disks, networks and interrupted copies leave them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "src/image/image_error.h"
#include "src/image/read.h"

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace strata::image {

// For as long as it lives, this thread's allocations are not looked at for leaks: on a damaged file OpenImageIO's PNG
// reader leaves by longjmp, past the destructors of its strings.
struct LibraryMayLeak {
#ifdef __SANITIZE_ADDRESS__
    LibraryMayLeak() { __lsan_disable(); }
    ~LibraryMayLeak() { __lsan_enable(); }
#endif
};

inline std::string with_flipped_bit(std::string bytes, std::mt19937& random) {
    bytes[random() % bytes.size()] ^= static_cast<char>(1 << random() % 8);
    return bytes;
}

// The first and the last few lengths, and others between; never the whole.
inline std::vector<std::size_t> cut_lengths(std::size_t size, std::mt19937& random) {
    std::vector<std::size_t> lengths{0, 1, 3, 8, 20};
    for (std::size_t end = 1; end <= 40; ++end) lengths.push_back(size - end);
    for (int i = 0; i < 60; ++i) lengths.push_back(random() % size);
    return lengths;
}

inline bool says_whole(const std::filesystem::path& path) {
    [[maybe_unused]] const LibraryMayLeak tolerated;
    try {
        return read_facts(path).integrity == Integrity::whole;
    } catch (const ImageError&) {
        return false;
    }
}

}  // namespace strata::image
