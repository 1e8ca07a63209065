#include "tools/report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace strata::tools::report {

std::string filled(std::string_view text, const std::vector<std::pair<std::string_view, std::string>>& values) {
    std::string result;
    for (;;) {
        const std::size_t begin = text.find("{{"), end = text.find("}}");
        if (begin == std::string_view::npos || end == std::string_view::npos) return result.append(text);
        const std::string_view name = text.substr(begin + 2, end - begin - 2);
        const auto found = std::ranges::find(values, name, &std::pair<std::string_view, std::string>::first);
        if (found == values.end()) throw std::logic_error(fmt::format("the page names {}", name));
        result.append(text.substr(0, begin)).append(found->second);
        text.remove_prefix(end + 2);
    }
}

std::string embedded(const Json& json) {
    std::string text;
    for (const char c : json.dump()) text += c == '<' ? std::string("\\u003c") : std::string(1, c);
    return text;
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '"')
            result += "&quot;";
        else
            result += c;
    }
    return result;
}

}  // namespace strata::tools::report
