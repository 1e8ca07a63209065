#include "tools/cli/text_file.h"

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

namespace strata::tools::cli {

std::optional<std::string> read_text_file(const std::filesystem::path& path, std::string& why) {
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    // A folder opens, but does not read; an empty file has nothing to insert, which is no failure to read.
    if (file && file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
    // What fails while a part is taken over is an error of `text`.
    if (file.is_open() && !file.bad() && !text.fail()) return text.str();
    why = std::generic_category().message(errno != 0 ? errno : EIO);
    return std::nullopt;
}

}  // namespace strata::tools::cli
