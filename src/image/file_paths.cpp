#include "src/image/file_paths.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <system_error>

#include "src/image/image_error.h"
#include "src/image/stream_target.h"

namespace strata::image {
namespace fs = std::filesystem;
namespace {

constexpr int kMostLinks = 40;  // as the kernel follows

std::uint32_t hash_of(std::string_view text) {
    std::uint32_t hash = 0x811c9dc5;  // FNV-1a
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x01000193;
    return hash;
}

bool is_inside_letter(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

std::size_t longest_name(const fs::path& folder) {
    constexpr std::size_t kUsual = 255;
    const long most = ::pathconf(folder.c_str(), _PC_NAME_MAX);
    return most > 0 ? static_cast<std::size_t>(most) : kUsual;
}

}  // namespace

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

fs::path end_of_links(const fs::path& path) {
    fs::path place = path;
    std::error_code error;
    for (int links = 0; fs::is_symlink(place, error); ++links) {
        const fs::path next = fs::read_symlink(place, error);
        if (error || links == kMostLinks) {
            const int why = error ? error.value() : ELOOP;
            throw ImageError(
                fmt::format("cannot write \"{}\": {}", path.string(), std::generic_category().message(why)));
        }
        place = place.parent_path() / next;
    }
    return place;
}

bool is_one_file(const fs::path& a, const fs::path& b) {
    if (stream_target(a) || stream_target(b)) return false;
    std::error_code error;
    if (fs::equivalent(a, b, error)) return true;
    const fs::path end_a = fs::weakly_canonical(fs::absolute(end_of_links(a)), error);
    if (error) return false;
    const fs::path end_b = fs::weakly_canonical(fs::absolute(end_of_links(b)), error);
    return !error && end_a == end_b;
}

std::string fitting_name(std::string_view beginning, std::string_view ending, std::size_t most) {
    std::string name(beginning);
    if (name.size() + ending.size() > most) {
        const std::string mark = fmt::format("~{:08x}", hash_of(beginning));
        const std::size_t around = mark.size() + ending.size();
        std::size_t kept = most > around ? most - around : 0;
        while (kept > 0 && is_inside_letter(name[kept])) --kept;
        name.resize(kept);
        name += mark;
    }
    return name.append(ending);
}

fs::path derived_path(const fs::path& path, std::string_view ending) {
    return path.parent_path() / fitting_name(path.stem().string(), ending, longest_name(folder_of(path)));
}

fs::path temporary_place() {
    const char* const chosen = std::getenv("TMPDIR");
    return chosen != nullptr && *chosen != '\0' ? chosen : "/tmp";
}

}  // namespace strata::image
