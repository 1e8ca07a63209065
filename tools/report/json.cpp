#include "tools/report/json.h"

#include <cmath>

namespace strata::tools::report {

Json number(double value, bool is_known) { return is_known && std::isfinite(value) ? Json(value) : Json(nullptr); }

Json number(const std::optional<double>& value) { return number(value.value_or(0), value.has_value()); }

Json counts_json(const integrate::Counters& counters) {
    Json json = Json::object();
    for (const auto& [name, member] : integrate::kCounters) json[name] = counters.*member;
    return json;
}

std::string text_of(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace strata::tools::report
