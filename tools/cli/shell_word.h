#pragma once

#include <string>
#include <string_view>

namespace strata::tools::cli {

// The text as a shell reads it back as one word: quoted where it must be.
std::string shell_word(std::string_view text);

}  // namespace strata::tools::cli
