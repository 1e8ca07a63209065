#include "tools/figures/page.h"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

#include "src/image/output_file.h"
#include "tools/figures/figure.h"
#include "tools/figures/figure_maker.h"
#include "tools/figures/films.h"
#include "tools/report/page.h"

namespace strata::tools::figures {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

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
    const report::PageTexts& texts = report::page_texts();
    return report::filled(texts.figures, {{"style", std::string(texts.style)},
                                          {"version", STRATA_VERSION},
                                          {"records", report::embedded({{"figures", figures}, {"films", films}})},
                                          {"script", std::string(texts.figures_script)}});
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
