#include "src/image/deflate_check.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <vector>

namespace strata::image {
namespace {

// Tags and types of TIFF 6.0.
constexpr unsigned kCompression = 259, kStripOffsets = 273, kStripSizes = 279, kTileOffsets = 324, kTileSizes = 325;
constexpr unsigned kDeflate = 8, kOldDeflate = 32946;
constexpr unsigned kShort = 3, kLong = 4;

using Numbers = std::vector<std::uint32_t>;

// The numbers in the file's first directory. What lies outside of the file reads as zeros: the library's own reading
// says what is wrong with such a file.
class TiffDirectory {
  public:
    explicit TiffDirectory(std::ifstream& file) : file_(file) {
        file_.seekg(0, std::ios::end);
        size_ = static_cast<std::uint64_t>(file_.tellg());
        is_big_endian_ = bytes_at<1>(0)[0] == 'M';
        const std::uint64_t start = number_at<4>(4);
        const std::uint32_t count = number_at<2>(start);
        for (std::uint32_t i = 0; i < count; ++i) add_entry(start + 2 + 12 * std::uint64_t{i});
    }

    Numbers numbers(unsigned tag) const {
        const auto found = entries_.find(tag);
        return found == entries_.end() ? Numbers{} : found->second;
    }

    std::uint64_t file_size() const { return size_; }

  private:
    template <std::size_t count>
    std::array<unsigned char, count> bytes_at(std::uint64_t offset) {
        std::array<unsigned char, count> bytes{};
        file_.clear();
        file_.seekg(static_cast<std::streamoff>(offset));
        file_.read(reinterpret_cast<char*>(bytes.data()), count);
        return bytes;
    }

    template <std::size_t count>
    std::uint32_t number_at(std::uint64_t offset) {
        const std::array<unsigned char, count> bytes = bytes_at<count>(offset);
        std::uint32_t number = 0;
        for (std::size_t i = 0; i < count; ++i) number = number << 8 | bytes[is_big_endian_ ? i : count - 1 - i];
        return number;
    }

    void add_entry(std::uint64_t entry) {
        const std::uint32_t tag = number_at<2>(entry), type = number_at<2>(entry + 2), count = number_at<4>(entry + 4);
        const std::uint64_t width = type == kShort ? 2 : 4;
        if ((type != kShort && type != kLong) || count * width > size_) return;
        const std::uint64_t begin = count * width <= 4 ? entry + 8 : number_at<4>(entry + 8);
        Numbers& numbers = entries_[tag];
        for (std::uint32_t i = 0; i < count; ++i) {
            numbers.push_back(width == 2 ? number_at<2>(begin + 2 * i) : number_at<4>(begin + 4 * std::uint64_t{i}));
        }
    }

    std::ifstream& file_;
    std::uint64_t size_ = 0;
    bool is_big_endian_ = false;
    std::map<unsigned, Numbers> entries_;
};

// zlib compares the checksum when it comes to the stream's end.
bool inflates(const std::vector<unsigned char>& packed) {
    z_stream stream{};
    if (inflateInit(&stream) != Z_OK) return true;  // no memory: nothing is known
    stream.next_in = const_cast<unsigned char*>(packed.data());
    stream.avail_in = static_cast<uInt>(packed.size());
    std::array<unsigned char, 1 << 15> unpacked;
    int status = Z_OK;
    while (status == Z_OK) {
        stream.next_out = unpacked.data();
        stream.avail_out = unpacked.size();
        status = inflate(&stream, Z_NO_FLUSH);
    }
    inflateEnd(&stream);
    return status == Z_STREAM_END;
}

}  // namespace

std::optional<std::string> find_deflate_damage(const std::filesystem::path& tiff) {
    std::ifstream file(tiff, std::ios::binary);
    const TiffDirectory directory(file);
    const Numbers compression = directory.numbers(kCompression);
    if (compression.empty() || (compression[0] != kDeflate && compression[0] != kOldDeflate)) return std::nullopt;
    const bool is_tiled = !directory.numbers(kTileOffsets).empty();
    const Numbers offsets = directory.numbers(is_tiled ? kTileOffsets : kStripOffsets);
    const Numbers sizes = directory.numbers(is_tiled ? kTileSizes : kStripSizes);
    std::vector<unsigned char> packed;
    for (std::size_t i = 0; i < std::min(offsets.size(), sizes.size()); ++i) {
        if (sizes[i] == 0) continue;  // left out on purpose: black
        const bool is_inside = std::uint64_t{offsets[i]} + sizes[i] <= directory.file_size();
        packed.resize(is_inside ? sizes[i] : 0);
        file.clear();
        file.seekg(offsets[i]);
        file.read(reinterpret_cast<char*>(packed.data()), static_cast<std::streamsize>(packed.size()));
        if (is_inside && inflates(packed)) continue;
        return fmt::format("{} {} of {} is damaged", is_tiled ? "tile" : "strip", i + 1, offsets.size());
    }
    return std::nullopt;
}

}  // namespace strata::image
