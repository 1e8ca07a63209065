#include "tools/strip/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "noise/simd_target.h"
#include "src/image/compare.h"
#include "src/image/difference.h"
#include "src/image/sheet.h"
#include "src/scene/enum_names.h"

namespace strata::tools::strip {

namespace {

constexpr int kScaleWidth = 320;

const Source* reference_of(const Job& job) {
    if (job.reference_column) return &job.columns[*job.reference_column];
    return job.reference ? &*job.reference : nullptr;
}

// Pictures from files are all shown alike; a rendered one may have been asked for with colours of its own.
image::ColourOut colour_of(const Job& job, const Source& column) {
    return column.file.empty() ? image::colour_out(column.scene->film) : job.colour;
}

std::string rmse_text(const image::Comparison& comparison) {
    std::string text = fmt::format("RMSE {:#.3g}", comparison.rmse);
    if (comparison.not_finite > 0) text += fmt::format("\n{} values not finite", comparison.not_finite);
    return text;
}

std::vector<image::Comparison> compare_all(const Job& job, const Source& reference) {
    std::vector<image::Comparison> comparisons;
    for (const Source& column : job.columns) comparisons.push_back(image::compare(column.picture, reference.picture));
    return comparisons;
}

// Few values lie beyond it, and none of them decides on it alone.
double choose_top(const Job& job, const std::vector<image::Comparison>& comparisons) {
    if (job.top) return *job.top;
    double largest = 0;
    for (const image::Comparison& c : comparisons) {
        if (std::isfinite(c.percentile99)) largest = std::max(largest, c.percentile99);
    }
    return image::scale_top(largest);
}

void add_difference(const Job& job, const Source& reference, const std::vector<image::Comparison>& comparisons,
                    image::Sheet& sheet) {
    const double top = choose_top(job, comparisons);
    std::vector<image::Panel> row;
    for (const Source& column : job.columns)
        row.push_back({image::magnify(image::difference(column.picture, reference.picture, top), job.zoom), "", false});
    sheet.rows.push_back(std::move(row));
    const int width = std::max(job.window.width() * job.zoom, kScaleWidth);
    sheet.scale = image::difference_scale(width, top,
                                          fmt::format("difference in linear radiance; reference: {}", reference.label));
}

}  // namespace

image::Canvas draw_strip(const Job& job) {
    image::Sheet sheet;
    sheet.title = job.title;
    sheet.caption = job.caption;
    sheet.rows.resize(1);
    for (const Source& column : job.columns) {
        sheet.column_labels.push_back(column.label);
        sheet.rows.front().push_back(
            {image::magnify(image::to_canvas(column.picture, colour_of(job, column)), job.zoom), "", false});
    }
    const Source* reference = reference_of(job);
    if (reference == nullptr) return image::compose(sheet);

    const std::vector<image::Comparison> comparisons = compare_all(job, *reference);
    if (job.difference) add_difference(job, *reference, comparisons, sheet);
    if (job.rmse) {
        for (std::size_t i = 0; i < job.columns.size(); ++i) {
            const bool is_reference = job.reference_column == i;
            sheet.rows.back()[i].note = is_reference ? "reference" : rmse_text(comparisons[i]);
        }
    }
    return image::compose(sheet);
}

image::Metadata strip_metadata(const Job& job) {
    const film::Rect& w = job.window;
    image::Metadata metadata;
    metadata.set("strata:version", STRATA_VERSION);
    for (std::size_t i = 0; i < job.columns.size(); ++i)
        metadata.set(fmt::format("strata:column_{}", i + 1), job.columns[i].name);
    if (const Source* reference = reference_of(job)) metadata.set("strata:reference", reference->name);
    metadata.set("strata:crop", fmt::format("{},{},{},{}", w.x0, w.y0, w.x1, w.y1));
    metadata.set("strata:zoom", job.zoom);
    metadata.set("strata:exposure", job.colour.exposure);
    if (job.colour.tone != scene::ToneCurve::none)
        metadata.set("strata:tone", std::string(scene::name_of(job.colour.tone)));
    metadata.set("strata:simd_target", noise::simd_target());
    // Not the scene's own entry: a strip is no picture that could be rendered again from it.
    if (!job.scene_text.empty()) metadata.set("strata:columns_scene", job.scene_text);
    return metadata;
}

}  // namespace strata::tools::strip
