// Figure 8: the wagon wheel, through a shutter and through the cubic B-spline in time.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "src/image/canvas.h"
#include "src/image/house_style.h"
#include "tools/figures/figure.h"
#include "tools/figures/wheel_rows.h"

namespace strata::tools::figures {

namespace figure_8 {
namespace {

constexpr int kSide = 300;  // px, at size paper
constexpr double kWheelCost = 0.05;

struct Row {
    const char* name;
    double spoke_Hz;
};
struct Column {
    const char* name;
    const char* label;
    int time_order;
};

constexpr Row kRows[] = {{"slow", kSlow_Hz}, {"fast", kFast_Hz}};
constexpr Column kColumns[] = {{"box", "box in time", 1}, {"cubic", "cubic in time", 4}};

std::string stem_of(const Row& row, const Column& column, int frame) {
    return fmt::format("figure-8-{}-{}-frame{}", row.name, column.name, frame);
}

// Row by row, in a row by filter, then by frame.
template <class Use>
void each_panel(const Use& use) {
    for (const Row& row : kRows) {
        for (const Column& column : kColumns) {
            for (const int frame : kWheelFrames) use(row, column, frame);
        }
    }
}

std::string label_of(const Row& row, const Column& column, int frame) {
    return fmt::format("{}, {}, frame {}", row.name, column.label, frame);
}

Plan plan(Size size) {
    Plan result;
    result.number = 8;
    result.title = "The wagon wheel";
    result.caption = fmt::format(
        "A wheel of {} spokes that turns counter-clockwise, at {} frames a second with the shutter open for {} s; two "
        "frames of each. Upper row: a spoke passes {} times a second, and every filter shows where the wheel turns to. "
        "Lower row: {} times a second. From frame to frame that looks like {} - {} = {} times, so that under the box, "
        "which is the shutter itself, the blur turns slowly clockwise, against the spokes; the orange mark, computed, "
        "follows one spoke or its image. The box leaves {:.2f} of the spokes' contrast, the cubic B-spline {:.3f}: an "
        "even disc, with no hint of rotation.",
        kWheelSpokes, kWheelFps, kWheelOpen_s, kSlow_Hz, kFast_Hz, kFast_Hz, kWheelFps, kFast_Hz - kWheelFps,
        wheel_gain(kFast_Hz, 1), wheel_gain(kFast_Hz, 4));
    result.chosen = {"the wheel, its number of spokes and both speeds: the paper's are lost",
                     "frames 0 and 2, so that the turn is plain", "both filters centred on the open shutter",
                     "the orange marks"};
    result.shown = {{"figure-8.png",
                     "Two rows of four wheels. Upper row, slow: spokes turned a little counter-clockwise in the second "
                     "frame of each pair, a little more blurred under the cubic. Lower row, fast: under the box, "
                     "blurred spokes turned clockwise; under the cubic, an even grey disc."}};
    each_panel([&](const Row& row, const Column& column, int frame) {
        const int side = scaled(kSide, size);
        const std::string stem = stem_of(row, column, frame);
        result.parts.push_back(
            {stem + ".exr", wheel_scene(row.spoke_Hz, column.time_order, frame, side), {0, 0, side, side}, kWheelCost});
        result.shown.push_back({stem + ".png", label_of(row, column, frame) + "."});
    });
    const auto compare = [&](const Row& row, const Column& a, int frame_a, const Column& b, int frame_b) {
        result.comparisons.push_back({stem_of(row, a, frame_a) + ".png", stem_of(row, b, frame_b) + ".png",
                                      label_of(row, a, frame_a), label_of(row, b, frame_b)});
    };
    compare(kRows[1], kColumns[0], kWheelFrames[0], kColumns[1], kWheelFrames[0]);
    compare(kRows[1], kColumns[0], kWheelFrames[0], kColumns[0], kWheelFrames[1]);
    result.parameters = {{"frames", kWheelFrames}, {"slow_Hz", kSlow_Hz}, {"fast_Hz", kFast_Hz}};
    for (const Row& row : kRows) {
        for (const Column& column : kColumns) {
            result.parameters["contrast_left"][fmt::format("{}, {}", row.name, column.label)] =
                wheel_gain(row.spoke_Hz, column.time_order);
        }
    }
    return result;
}

// Just outside of the rim, at the angle of a spoke's image in this frame: the spoke of mid-shutter.
void mark_spoke(image::Canvas& canvas, const scene::Scene& scene) {
    const double time_s = scene.shutter.time_s() + 0.5 * scene.shutter.open_s;
    const double pitches = std::fmod(scene.wheel.turns_per_s * scene.wheel.spokes * time_s, 1.0);
    // Of all spokes, images of each other, the one that the eye follows from frame 0: the nearest.
    const double seen_Hz =
        scene.wheel.turns_per_s * scene.wheel.spokes > 0.5 * scene.shutter.fps ? kFast_Hz - kWheelFps : kSlow_Hz;
    const double start = std::fmod(scene.wheel.turns_per_s * scene.wheel.spokes * 0.5 * scene.shutter.open_s, 1.0);
    const double expected = start + seen_Hz * scene.shutter.frame / scene.shutter.fps;
    const double turn = (pitches + std::round(expected - pitches)) / scene.wheel.spokes;
    const double angle = 2 * std::numbers::pi * turn + 0.5 * std::numbers::pi;  // a spoke at the top
    const double centre = 0.5 * canvas.width;
    const int x = static_cast<int>(std::lround(centre + 0.95 * centre * std::cos(angle)));
    const int y = static_cast<int>(std::lround(centre - 0.95 * centre * std::sin(angle)));
    const int r = std::max(2, canvas.width / 75);
    image::fill(canvas, {x - r, y - r, x + r + 1, y + r + 1}, image::house::kMark);
}

void draw(const Plan& plan, Pictures pictures, const std::filesystem::path& folder) {
    image::Sheet sheet;
    for (const Row& row : kRows) sheet.row_labels.emplace_back(row.name);
    sheet.rows.resize(std::size(kRows));
    std::size_t i = 0;
    each_panel([&](const Row& row, const Column& column, int frame) {
        image::Canvas canvas = image::to_canvas(pictures[i]);
        image::write_canvas(folder / plan.shown[i + 1].file, canvas);
        if (wheel_gain(row.spoke_Hz, column.time_order) > 0.1) mark_spoke(canvas, plan.parts[i].scene);
        if (&row == &kRows[0]) sheet.column_labels.push_back(fmt::format("{}, frame {}", column.label, frame));
        sheet.rows[static_cast<std::size_t>(&row - kRows)].push_back({canvas, "", false});
        ++i;
    });
    write_sheet(plan, std::move(sheet), folder);
}

}  // namespace
}  // namespace figure_8

scene::Scene wheel_scene(double spoke_Hz, int time_order, int frame, int side) {
    scene::Scene scene = builtin("wheel");
    scene.film.width = scene.film.height = side;
    scene.sampling.estimator = scene::EstimatorKind::stratified;
    scene.sampling.N = 10;
    scene.sampling.m = 4;
    scene.sampling.time_order = time_order;
    scene.shutter = {.fps = kWheelFps, .open_s = kWheelOpen_s, .frame = frame};
    scene.wheel.spokes = kWheelSpokes;
    scene.wheel.turns_per_s = spoke_Hz / kWheelSpokes;
    return scene;
}

double wheel_gain(double spoke_Hz, int time_order) {
    const double x = std::numbers::pi * spoke_Hz * kWheelOpen_s;
    return std::pow(std::abs(std::sin(x) / x), time_order);
}

const Figure kFigure8{8, false, figure_8::plan, figure_8::draw};

}  // namespace strata::tools::figures
