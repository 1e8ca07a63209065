// An input as a file, in memory where that can be.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

namespace strata::fuzz {

class ScratchFile {
  public:
    ScratchFile(std::span<const unsigned char> bytes, const std::string& ending)
        : path_(folder() / ("input" + ending)) {
        std::ofstream(path_, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
    ~ScratchFile() { std::filesystem::remove(path_); }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    const std::filesystem::path& path() const { return path_; }

    // This process's own.
    static const std::filesystem::path& folder() {
        static const std::filesystem::path made = [] {
            const std::filesystem::path shared = "/dev/shm";
            std::string name =
                ((std::filesystem::exists(shared) ? shared : std::filesystem::temp_directory_path()) / "fuzz-XXXXXX")
                    .string();
            if (::mkdtemp(name.data()) == nullptr) std::abort();
            std::atexit([] {
                std::error_code ignored;
                std::filesystem::remove_all(folder(), ignored);
            });
            return std::filesystem::path(name);
        }();
        return made;
    }

  private:
    std::filesystem::path path_;
};

}  // namespace strata::fuzz
