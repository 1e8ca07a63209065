// JSON as all reports have it.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "src/integrate/image_function.h"

namespace strata::tools::report {

using Json = nlohmann::ordered_json;

// null where nothing is known: JSON has neither infinity nor NaN.
Json number(double value, bool is_known = true);
Json number(const std::optional<double>& value);

// Every count, by its name.
Json counts_json(const integrate::Counters& counters);

// A file's text. Bytes that are no UTF-8, which the name of a scene's file may hold, are replaced.
std::string text_of(const Json& json);

}  // namespace strata::tools::report
