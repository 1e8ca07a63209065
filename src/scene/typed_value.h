// What somebody types for a key on a command line, which is not quite TOML.
#pragma once

#include <string>
#include <string_view>

#include "src/scene/keys.h"

namespace strata::scene {

// As TOML: text without quotes in quotes where the key takes text, numbers spelt as TOML wants them.
std::string toml_of_typed(const Key& key, std::string_view typed);

// Text that begins with a letter, on one line: the name of a choice, perhaps.
bool is_bare_word(std::string_view text);

}  // namespace strata::scene
