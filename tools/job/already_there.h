// Whether a file is there already, whole and the very one that would be made: what every command asks that goes on
// where it was stopped.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "src/image/metadata.h"
#include "src/image/picture.h"

namespace strata::tools::job {

enum class Presence {
    missing,
    same,
    damaged,  // empty, cut, unreadable, or of other bytes than were written: to be made again
    other     // made by other settings or something else
};

struct Found {
    Presence presence = Presence::missing;
    std::string why;  // of what is damaged or other, without the file's name
};

// By the metadata, which are exactly these, the windows, and the digest of all bytes; no pixel is decoded.
Found find_picture(const std::filesystem::path& path, const image::Metadata& expected,
                   const image::PictureShape& shape);

// By a digest that was kept beside a file of any kind (image::digest_of_file).
Found find_file(const std::filesystem::path& path, std::string_view digest);

// What becomes of a file that is there and is another one.
enum class IfOther { replace, refuse };

// Whether the picture is there already, so that it need not be made. Tells that it is damaged unless quiet. Throws
// UsageError for another one that is not to be replaced.
bool is_kept(const std::filesystem::path& path, const image::Metadata& expected, const image::PictureShape& shape,
             IfOther other, bool quiet);

// A line on standard output: that the file is damaged, why, and that it is made again.
void tell_damaged(const std::filesystem::path& path, const Found& found);

}  // namespace strata::tools::job
