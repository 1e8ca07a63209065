#include "tools/figures/surface_areas.h"

#include <fmt/format.h>

#include <algorithm>

namespace strata::tools::figures {

namespace {

constexpr int kWidth = 1280, kHeight = 720;
constexpr int kDetail = 64;  // px a side, at size paper
constexpr int kZoom = 5;     // at size paper

// With this corner at size paper.
film::Rect detail_at(int x, int y, Size size) {
    const int left = scaled(x, size), top = scaled(y, size), side = scaled(kDetail, size);
    return {left, top, left + side, top + side};
}

int zoom_of(const Plan& plan) { return plan.parameters.at("zoom"); }

}  // namespace

scene::Scene surface_scene(Size size) {
    scene::Scene scene = builtin(kSurfaceScene);
    scene.film.width = scaled(kWidth, size);
    scene.film.height = scaled(kHeight, size);
    scene.sampling.estimator = scene::EstimatorKind::stratified;
    scene.sampling.N = kSurfaceSamples;
    scene.sampling.m = 4;
    return scene;
}

film::Rect detail_of_figure_6(Size size) { return detail_at(564, 70, size); }
film::Rect detail_of_figure_7(Size size) { return detail_at(792, 80, size); }

void add_detail(Plan& plan, Size size, const film::Rect& window, std::span<const DetailColumn> columns) {
    const auto single = [&](const DetailColumn& column) {
        return fmt::format("figure-{}-{}.png", plan.number, column.name);
    };
    for (const DetailColumn& column : columns) {
        scene::Scene scene = surface_scene(size);
        scene.sampling.estimator = column.antialiased ? scene::EstimatorKind::stratified : scene::EstimatorKind::none;
        scene.sampling.N = column.N;
        scene.sampling.m = column.m;
        plan.parts.push_back({fmt::format("figure-{}-{}.exr", plan.number, column.name), scene, window});
        plan.shown.push_back({single(column), fmt::format("The area with {}.", column.label)});
        if (&column != &columns.front()) {
            plan.comparisons.push_back({single(columns.front()), single(column), columns.front().label, column.label});
        }
    }
    // Panels are equally large at every size.
    plan.parameters["zoom"] = std::max(1, kZoom * kDetail / window.width());
}

void draw_detail(const Plan& plan, Pictures pictures, const std::filesystem::path& folder,
                 std::span<const DetailColumn> columns) {
    image::Sheet sheet;
    sheet.rows.resize(1);
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const image::Canvas canvas = image::to_canvas(pictures[i], image::colour_out(plan.parts[i].scene.film));
        sheet.column_labels.push_back(columns[i].label);
        sheet.rows.front().push_back({image::magnify(canvas, zoom_of(plan)), "", false});
        image::write_canvas(folder / plan.shown[i + 1].file, sheet.rows.front().back().picture);
    }
    write_sheet(plan, std::move(sheet), folder);
}

}  // namespace strata::tools::figures
