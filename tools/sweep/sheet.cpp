#include "tools/sweep/sheet.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "src/image/read.h"
#include "src/image/sheet.h"
#include "src/scene/enum_names.h"

namespace strata::tools::sweep {

namespace {

constexpr int kLeastWidth = 240;  // px of a panel, by magnification
constexpr int kMostZoom = 16;
constexpr int kLongestPanelSide = 480;

// How a picture gets a panel: each pixel shown as zoom x zoom, or shrink x shrink of them as one.
struct Scaling {
    int zoom = 1, shrink = 1;
};

Scaling scaling_of(const Job& job) {
    int width = 0, longest = 0;
    for (const Cell& cell : job.cells) {
        width = std::max(width, cell.picture.window.width());
        longest = std::max({longest, width, cell.picture.window.height()});
    }
    return {.zoom = std::clamp(std::min((kLeastWidth + width - 1) / width, kLongestPanelSide / longest), 1, kMostZoom),
            .shrink = (longest + kLongestPanelSide - 1) / kLongestPanelSide};
}

// Pixels at the right and lower edge that do not fill a block are left out.
image::Picture shrunk(const image::Picture& picture, int n) {
    if (n == 1 || picture.width() < n || picture.height() < n) return picture;
    image::Picture small = image::make_picture(picture.width() / n, picture.height() / n);
    for (int y = 0; y < small.height(); ++y) {
        for (int x = 0; x < 3 * small.width(); ++x) {
            double sum = 0;
            for (int i = 0; i < n * n; ++i) {
                const int source_x = 3 * (x / 3 * n + i % n) + x % 3, source_y = y * n + i / n;
                sum += picture.rgb[static_cast<std::size_t>(source_y) * 3 * static_cast<std::size_t>(picture.width()) +
                                   static_cast<std::size_t>(source_x)];
            }
            small.rgb[static_cast<std::size_t>(y) * 3 * static_cast<std::size_t>(small.width()) +
                      static_cast<std::size_t>(x)] = static_cast<float>(sum / (n * n));
        }
    }
    return small;
}

image::Panel make_panel(const Job& job, const Results& results, std::size_t i, const Scaling& scaling) {
    const Picture& picture = job.cells[i].picture;
    const image::Picture linear = shrunk(image::read_picture(job.folder / picture.file), scaling.shrink);
    image::Panel panel{image::magnify(image::to_canvas(linear, image::colour_out(picture.scene.film)), scaling.zoom),
                       "", false};
    if (results.cells[i]) {
        panel.note =
            fmt::format("RMSE {:#.3g}{}", results.cells[i]->rmse, results.is_near_reference(job, i) ? " *" : "");
    }
    return panel;
}

std::vector<std::string> labels_of_axis(const std::optional<Axis>& axis) {
    std::vector<std::string> labels;
    for (std::size_t i = 0; axis && i < axis->values.size(); ++i) labels.push_back(value_label(*axis, i));
    return labels;
}

std::string reference_text(const Job& job, const Results& results) {
    if (job.given_reference) return fmt::format("RMSE of linear radiance against {}. ", job.given_reference_name);
    if (job.references.empty()) return "";
    const int N = job.references.front().halves[0].scene.sampling.N;
    std::vector<std::string> errors;
    for (std::size_t r = 0; r < job.references.size(); ++r) {
        const std::string& label = job.references[r].label;
        errors.push_back(
            fmt::format("{:#.2g}{}", results.reference_errors[r], label.empty() ? "" : " (" + label + ")"));
    }
    const bool one = errors.size() == 1;
    std::string text = fmt::format(
        "RMSE of linear radiance against {}: the mean of two independent shared-sobol pictures of N = {}, whose own "
        "RMSE is about {}. ",
        one ? "a reference of the same filter" : "a reference for each filter and scene", N, fmt::join(errors, ", "));
    for (std::size_t i = 0; i < job.cells.size(); ++i) {
        if (!results.is_near_reference(job, i)) continue;
        return text + fmt::format("* within {:.0f} times that: partly the reference's error. ", kTrustFactor);
    }
    return text;
}

std::string scaling_text(const Job& job, const Scaling& scaling) {
    const film::Rect& w = job.cells.front().picture.window;
    std::string text = fmt::format("{}×{} pixels", w.width(), w.height());
    if (scaling.zoom > 1) text += fmt::format(", each shown as {0}×{0}", scaling.zoom);
    if (scaling.shrink > 1) text += fmt::format(", {0}×{0} of them shown as one", scaling.shrink);
    return text + ".";
}

std::string title_of(const Job& job) {
    return job.loaded.scene.title.empty() ? job.loaded.name : job.loaded.scene.title;
}

std::string fixed_text(const Job& job) {
    const auto varies = [&](std::string_view key) {
        return (job.axes.rows && job.axes.rows->key == key) || (job.axes.columns && job.axes.columns->key == key);
    };
    const scene::Sampling& sampling = job.cells.front().picture.scene.sampling;
    std::vector<std::string> parts;
    if (!varies("sampling.estimator")) parts.push_back(std::string(scene::name_of(sampling.estimator)));
    if (!varies("sampling.N")) parts.push_back(fmt::format("N = {}", sampling.N));
    if (!varies("sampling.m")) parts.push_back(fmt::format("m = {}", sampling.m));
    return fmt::format("All: {}. ", fmt::join(parts, ", "));
}

}  // namespace

image::Canvas draw_sheet(const Job& job, const Results& results) {
    const Scaling scaling = scaling_of(job);
    image::Sheet sheet;
    sheet.title = title_of(job);
    sheet.column_labels = labels_of_axis(job.axes.columns);
    sheet.row_labels = labels_of_axis(job.axes.rows);
    sheet.rows.resize(job.rows());
    for (std::size_t i = 0; i < job.cells.size(); ++i)
        sheet.rows[job.cells[i].row].push_back(make_panel(job, results, i, scaling));
    sheet.caption = fixed_text(job) + reference_text(job, results) + scaling_text(job, scaling);
    return image::compose(sheet);
}

image::Metadata sheet_metadata(const Job& job) {
    image::Metadata metadata;
    metadata.set("strata:version", STRATA_VERSION);
    const auto set = [&](const char* name, const std::optional<Axis>& axis) {
        if (axis) metadata.set(name, fmt::format("{}={}", axis->key, fmt::join(axis->values, ",")));
    };
    set("strata:columns", job.axes.columns);
    set("strata:rows", job.axes.rows);
    metadata.set("strata:sweep_of", job.loaded.name);
    return metadata;
}

}  // namespace strata::tools::sweep
