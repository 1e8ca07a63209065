// From a node of toml++ to a key's field. Only the reader's own units see toml++.
#pragma once

#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include <optional>
#include <string>

#include "src/scene/keys.h"
#include "src/scene/scene_text.h"

namespace strata::scene {

using MaybeFault = std::optional<Fault>;

Fault fault_at(const toml::source_position& at, std::string message);

// A value as a message repeats it.
std::string node_text(const toml::node& node);

// Stores what the node says into the key's field, if the key allows it.
MaybeFault assign_node(const Key& key, const toml::node& node);

}  // namespace strata::scene
