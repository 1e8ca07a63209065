// Pages of HTML that are one file, with style and script within, beside the pictures that they show.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/report/json.h"

namespace strata::tools::report {

// What pages are made of, as embedded when the program was built (embed_pages.cmake).
struct PageTexts {
    std::string_view style;  // of all pages
    std::string_view figures, figures_script;
    std::string_view gallery;
};
const PageTexts& page_texts();

// Replaces each {{name}} of the template once; what is put in is not looked at again.
std::string filled(std::string_view text, const std::vector<std::pair<std::string_view, std::string>>& values);

// JSON as it may stand in a script element: no text of it ends that.
std::string embedded(const Json& json);

// Text as it may stand in an element or in quotes in a tag.
std::string escaped(std::string_view text);

}  // namespace strata::tools::report
