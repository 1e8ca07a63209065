#include "tools/figures/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "src/image/output_file.h"
#include "tools/figures/figure.h"
#include "tools/figures/figure_maker.h"
#include "tools/figures/films.h"

namespace strata::tools::figures {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

// Replaces each {{name}} of the template once; what is put in is not looked at again.
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

// JSON as it may stand in a script element: no text of it ends that.
std::string embedded(const ordered_json& json) {
    std::string text;
    for (const char c : json.dump()) text += c == '<' ? std::string("\\u003c") : std::string(1, c);
    return text;
}

// Of the records that are there and not emptied (record.h).
std::vector<ordered_json> records_of(const std::vector<fs::path>& paths) {
    std::vector<ordered_json> records;
    for (const fs::path& path : paths) {
        std::ifstream file(path);
        if (!file) continue;
        ordered_json record = ordered_json::parse(file, nullptr, /*allow_exceptions=*/false);
        if (!record.is_object())
            throw std::runtime_error(fmt::format("{}: it is no record of a figure", path.string()));
        if (!record.empty()) records.push_back(std::move(record));
    }
    return records;
}

}  // namespace

std::string page_of(const std::vector<ordered_json>& figures, const std::vector<ordered_json>& films) {
    const PageTexts& texts = page_texts();
    return filled(texts.html, {{"style", std::string(texts.css)},
                               {"version", STRATA_VERSION},
                               {"records", embedded({{"figures", figures}, {"films", films}})},
                               {"script", std::string(texts.js)}});
}

void write_page(const fs::path& folder) {
    std::vector<fs::path> figure_paths, film_paths;
    for (const Figure& figure : all_figures()) figure_paths.push_back(record_path(folder, figure.number));
    for (const Film& film : films(Size::paper)) film_paths.push_back(folder / (film.name + ".json"));
    const std::vector<ordered_json> figure_records = records_of(figure_paths);
    if (figure_records.empty()) throw std::runtime_error(fmt::format("{}: no figures for a page", folder.string()));
    image::replace_file(folder / "index.html", page_of(figure_records, records_of(film_paths)));
}

}  // namespace strata::tools::figures
