#include "tools/gallery/wall.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/image/read.h"
#include "src/image/sheet.h"
#include "src/scene/enum_names.h"
#include "src/scene/needs.h"
#include "tools/report/page.h"

namespace strata::tools::gallery {

namespace {

constexpr std::size_t kMostColumns = 6;

// Of about as many rows as columns, the last one as full as can be; three rows at least look like a wall.
std::size_t columns_of(std::size_t count) {
    const auto root = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    return std::clamp<std::size_t>(root, 1, kMostColumns);
}

// The codes as they are in the file.
image::Canvas canvas_of(const std::filesystem::path& path) {
    image::Picture codes = image::read_picture(path);
    return {codes.width(), codes.height(), std::move(codes.rgb)};
}

std::string settings_text(const job::FolderPicture& picture, const job::Ledger& ledger) {
    const scene::Scene& scene = picture.scene;
    std::string text =
        fmt::format("{} × {} pixels, {} samples each ({}, N = {})", picture.window.width(), picture.window.height(),
                    scene::samples_a_pixel(scene.sampling), scene::name_of(scene.sampling.estimator), scene.sampling.N);
    if (const auto cost = job::find_cost(ledger, picture.file, picture.metadata)) {
        text += fmt::format(", {:.1f} s on {} {}, {:.1f} s of processor time", cost->seconds, cost->threads,
                            cost->threads == 1 ? "thread" : "threads", cost->cpu_seconds);
    }
    return text;
}

std::string figure_of(const Tile& tile, const job::Ledger& ledger) {
    const job::FolderPicture& shown = tile.large ? *tile.large : tile.small;
    return fmt::format(
        R"(<figure id="{0}"><a href="{1}"><img loading="lazy" src="{2}" alt="{3}" width="{4}" height="{5}"></a>
<figcaption><h2>{6}</h2><p>{3}</p><p class="label">{7}</p><pre><code>{8}</code></pre></figcaption></figure>
)",
        report::escaped(std::filesystem::path(shown.file).stem().string()), report::escaped(shown.file),
        report::escaped(tile.small.file), report::escaped(tile.title), tile.small.window.width(),
        tile.small.window.height(), report::escaped(tile.name), report::escaped(settings_text(shown, ledger)),
        report::escaped(tile.command));
}

}  // namespace

image::Canvas draw_wall(const std::filesystem::path& folder, const std::vector<Tile>& tiles, const std::string& title) {
    image::Sheet sheet;
    sheet.title = title;
    const std::size_t columns = columns_of(tiles.size());
    sheet.rows.resize((tiles.size() + columns - 1) / columns, std::vector<image::Panel>(columns));
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const Tile& tile = tiles[i];
        sheet.rows[i / columns][i % columns] = {canvas_of(folder / tile.small.file),
                                                tile.large ? tile.name : tile.command, false};
    }
    return image::compose(sheet);
}

std::string page_of(const std::vector<Tile>& tiles, const job::Ledger& ledger, const std::string& title,
                    const std::string& introduction) {
    const report::PageTexts& texts = report::page_texts();
    std::string pictures;
    for (const Tile& tile : tiles) pictures += figure_of(tile, ledger);
    return report::filled(texts.gallery, {{"style", std::string(texts.style)},
                                          {"title", report::escaped(title)},
                                          {"introduction", report::escaped(introduction)},
                                          {"pictures", pictures},
                                          {"version", STRATA_VERSION}});
}

}  // namespace strata::tools::gallery
