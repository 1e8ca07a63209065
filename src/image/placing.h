// How every file gets its name: made whole under a hidden one beside it, then put in its place.
#pragma once

#include <filesystem>
#include <string>

namespace strata::image {

// A hidden file beside `target`, ".strata-" and random letters, made exclusively: no other process has it, on whatever
// machine it shares the folder. Where the folder takes no new file but the target is there and can be written, it is in
// TMPDIR. Known to scratch_files.h; removed by the destructor unless place() was reached.
class ScratchFile {
  public:
    // A dangling symbolic link is followed to the file it asks for. Throws ImageError with the system's reason.
    // `target` is no stream (stream_target.h).
    explicit ScratchFile(const std::filesystem::path& target);
    ~ScratchFile();
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    // Open for reading and writing, until the end of this object.
    int descriptor() const { return descriptor_; }

    // For programs that write it by name.
    const std::filesystem::path& path() const { return hidden_; }

    // Gives the file its name. An earlier file is replaced at once and as a whole, and what its owner set stays: mode
    // and access list, owner and group as far as that is permitted. A symbolic link stays one. Where the name cannot be
    // given - the target is a mount, or in a folder that takes no changes any more - the bytes go into the file that is
    // there. Where that cannot be either, throws ImageError that says why and where the whole file lies: beside the
    // target as NAME.kept.EXT, else in TMPDIR. What is whole is never removed. Throws too if the folder was moved: the
    // file is in it. Throws and keeps nothing when the system says only now that the bytes could not be stored.
    void place();

    // Gives up on the target for this reason: keeps the file as place() does, and throws.
    [[noreturn]] void keep(const std::string& reason);

  private:
    ScratchFile(const std::filesystem::path& target, bool is_second);
    int open_in(const std::filesystem::path& folder);
    void close_all();
    void drop();
    void check_folder_stayed();
    int move_into_place();
    int copy_into_place();
    bool copy_beside();
    std::filesystem::path keep_in_folder();
    std::filesystem::path keep_elsewhere();
    bool has_folder() const;
    std::filesystem::path folder_now() const;

    std::filesystem::path typed_, target_;
    std::filesystem::path hidden_;
    std::string name_;                   // of the hidden file
    int folder_ = -1, descriptor_ = -1;  // the hidden file's folder, which may be moved
    bool is_beside_ = true;              // the target; else in TMPDIR
    bool is_second_ = false;             // made by place() of another one
    bool is_done_ = false;               // needs no removing
};

}  // namespace strata::image
