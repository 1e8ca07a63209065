// Finding keys by name, and explaining names that are none.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "src/scene/keys.h"

namespace strata::scene {

// "section.key" parted at its last dot: a term of the relief has one in its section's name. No dot: the top of the
// file.
struct KeyPath {
    std::string_view section, name;
};
KeyPath key_path(std::string_view full_name);

// The section or key of that name, or null. An empty section name is the top of the file.
const Section* find_section(std::span<const Section> sections, std::string_view name);
const Key* find_key(const Section& section, std::string_view name);

// `name: unknown key, allowed in [camera]: ..., did you mean 'camera.fov_deg'?` section may be unknown as well.
std::string unknown_key(std::span<const Section> sections, std::string_view section, std::string_view name);

// `name: unknown section, allowed: ..., did you mean [camera]?`
std::string unknown_section(std::span<const Section> sections, std::string_view name);

}  // namespace strata::scene
