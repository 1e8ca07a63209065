// Scene files in. The only unit that sees toml++.
#pragma once

#include <string>
#include <string_view>

#include "src/scene/keys.h"
#include "src/scene/scene.h"
#include "src/scene/scene_error.h"

namespace strata::scene {

// A scene file's text, checked key by key against keys.h; keys that it leaves out keep their defaults. source_name
// stands in front of the message, line and column (in code points) from 1: what a SceneError names is the first in
// the file of: bad syntax, else an unknown section or key, a wrong type, a value out of range. Text without any key is
// an error. Checks across keys are validate()'s.
Scene read_scene(std::string_view text, std::string_view source_name);

// read_scene of a file; SceneError also for what cannot be read.
Scene load_scene(const std::string& path);

// Sets one key from what somebody typed for it: a TOML value, with numbers spelt as in typed_number.h. Text that begins
// with no quote is a string as it stands where the key takes text; elsewhere words are, such as the names of choices.
// SceneError, beginning with the key's name.
void assign_value(const Key& key, std::string_view typed);

}  // namespace strata::scene
