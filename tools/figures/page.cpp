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

std::string text_of(const ordered_json& value) { return escaped(value.get<std::string>()); }

std::string anchor_of(const ordered_json& record) { return fmt::format("figure-{}", record.at("figure").get<int>()); }

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

std::string alt_of(const ordered_json& record, const ordered_json& file) {
    for (const ordered_json& shown : record.at("shown")) {
        if (shown.at("file") == file) return text_of(shown.at("alt"));
    }
    throw std::runtime_error(
        fmt::format("figure {}: {} is compared and not shown", record.at("figure").dump(), file.dump()));
}

std::string slider(const ordered_json& record, const ordered_json& pair) {
    const std::string left = text_of(pair.at("left_label")), right = text_of(pair.at("right_label"));
    return fmt::format(
        "<div class=\"comparison\">\n<p class=\"labels\"><span>{0}</span><span>{1}</span></p>\n<div class=\"stage\">"
        "<img src=\"{2}\" alt=\"{3}\" loading=\"lazy\"><img class=\"right\" src=\"{4}\" alt=\"{5}\" loading=\"lazy\">"
        "</div>\n<input type=\"range\" min=\"0\" max=\"100\" step=\"1\" value=\"50\" aria-label=\"Divide between {0}, "
        "left, and {1}, right\">\n</div>\n",
        left, right, text_of(pair.at("left")), alt_of(record, pair.at("left")), text_of(pair.at("right")),
        alt_of(record, pair.at("right")));
}

std::string sliders(const ordered_json& record) {
    if (record.at("comparisons").empty()) return "";
    std::string text = "<div class=\"comparisons\">\n";
    for (const ordered_json& pair : record.at("comparisons")) text += slider(record, pair);
    return text + "</div>\n";
}

// The whole figure, as vector graphics where it is a plot.
std::string main_picture(const ordered_json& record) {
    const ordered_json& shown = record.at("shown");
    const auto vector = std::ranges::find_if(
        shown, [](const ordered_json& file) { return file.at("file").get<std::string>().ends_with(".svg"); });
    const std::string file = text_of((vector != shown.end() ? *vector : shown.front()).at("file"));
    return fmt::format("<a class=\"whole\" href=\"{0}\"><img src=\"{0}\" alt=\"{1}\"></a>\n", file,
                       text_of(shown.front().at("alt")));
}

std::string chosen(const ordered_json& record) {
    if (record.at("chosen").empty()) return "";
    std::string text = "<div class=\"chosen\"><p class=\"label\">Chosen here, not told by the paper:</p>\n<ul>\n";
    for (const ordered_json& choice : record.at("chosen")) text += fmt::format("<li>{}</li>\n", text_of(choice));
    return text + "</ul></div>\n";
}

std::string link_to(const std::string& file) { return fmt::format("<li><a href=\"{0}\">{0}</a></li>\n", file); }

std::string files(const ordered_json& record) {
    std::string text = "<details><summary>Files</summary>\n<ul class=\"files\">\n";
    for (const ordered_json& shown : record.at("shown")) text += link_to(text_of(shown.at("file")));
    for (const ordered_json& part : record.at("parts")) text += link_to(text_of(part.at("file")));
    for (const ordered_json& file : record.at("data")) text += link_to(text_of(file));
    text += link_to(anchor_of(record) + ".json");
    return text + "</ul></details>\n";
}

std::string parameters(const ordered_json& record) {
    ordered_json shown = {{"size", record.at("size")},
                          {"version", record.at("version")},
                          {"simd_target", record.at("simd_target")},
                          {"parameters", record.at("parameters")},
                          {"parts", record.at("parts")}};
    return fmt::format("<details><summary>Parameters</summary>\n<pre>{}</pre></details>\n", escaped(shown.dump(2)));
}

std::string section(const ordered_json& record) {
    return fmt::format(
        "<section id=\"{}\">\n<h2>Figure {}. {}</h2>\n<figure>\n{}<figcaption>{}</figcaption>\n</figure>\n{}{}"
        "<pre><code>{}</code></pre>\n{}{}</section>\n",
        anchor_of(record), record.at("figure").get<int>(), text_of(record.at("title")), main_picture(record),
        text_of(record.at("caption")), sliders(record), chosen(record), text_of(record.at("command")),
        parameters(record), files(record));
}

std::string film_section(const ordered_json& film) {
    std::string sources;
    for (const ordered_json& file : film.at("files")) {
        const std::string name = file.get<std::string>();
        sources += fmt::format("<source src=\"{}\" type=\"video/{}\">", escaped(name),
                               escaped(name.substr(name.rfind('.') + 1)));
    }
    return fmt::format(
        "<section id=\"{0}\">\n<h2>{1}</h2>\n<figure>\n<video controls loop muted playsinline "
        "aria-label=\"{2}\">{3}</video>\n<figcaption>{2}</figcaption>\n</figure>\n<pre><code>{4}</code></pre>\n"
        "</section>\n",
        text_of(film.at("animation")), text_of(film.at("title")), text_of(film.at("caption")), sources,
        text_of(film.at("command")));
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

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\'':
                result += "&#39;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string page_of(const std::vector<ordered_json>& figures, const std::vector<ordered_json>& films) {
    std::string contents, sections;
    const auto add = [&](const std::string& anchor, const std::string& name, const std::string& text) {
        contents += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", anchor, name);
        sections += text;
    };
    for (const ordered_json& record : figures) {
        add(anchor_of(record), fmt::format("Figure {}", record.at("figure").get<int>()), section(record));
    }
    for (const ordered_json& film : films) {
        const std::string title = text_of(film.at("title"));
        add(text_of(film.at("animation")), title.substr(0, title.find('.')), film_section(film));
    }
    const PageTexts& texts = page_texts();
    return filled(texts.html, {{"style", std::string(texts.css)},
                               {"script", std::string(texts.js)},
                               {"version", STRATA_VERSION},
                               {"contents", contents},
                               {"figures", sections}});
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
