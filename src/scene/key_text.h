// Keys in words: their values as TOML, what they allow, and what is wrong with a value.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/scene/keys.h"

namespace strata::scene {

// Whether it may name an entry of a list: a letter, then letters, digits, '_' and '-', 64 at most.
bool is_name(std::string_view name);

// A double as TOML: the shortest decimal that reads back as the same bits, always with a point or an exponent.
std::string number_text(double value);

// A string as TOML, in double quotes.
std::string quoted(std::string_view text);

// What a message repeats of the user's text: on one line, the end of a long one left out, UTF-8 characters whole.
std::string excerpt(std::string_view text);

// An entry of camera.keys as an inline table of TOML.
std::string camera_key_text(const CameraKey& entry);

// The present value of the key's field as TOML; camera keys a line each.
std::string value_text(const Key& key);

// What is wrong with the time of entry i, seen from the one before it.
std::optional<std::string> time_problem(const std::vector<CameraKey>& entries, std::size_t i);

// What the key takes, with its unit: "0.01 to 179 degrees".
std::string allowed_text(const Key& key);

// What is wrong with value as the key's number, or as a component of its vector: "out of range".
std::optional<std::string> number_problem(const Key& key, double value);

// What is wrong with the present value of the key's field. Of camera.keys: what is wrong with their number and order;
// the values of each are keys of their own (describe_camera_key).
std::optional<std::string> field_problem(const Key& key);

// `name: problem (value), allowed: ...`
std::string complaint(const Key& key, std::string_view problem, std::string_view value);

}  // namespace strata::scene
