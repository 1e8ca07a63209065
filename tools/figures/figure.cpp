#include "tools/figures/figure.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "noise/simd_target.h"
#include "src/scene/builtin.h"
#include "src/scene/key_text.h"
#include "src/scene/keys.h"
#include "src/scene/toml_reader.h"

namespace strata::tools::figures {

namespace {

using nlohmann::ordered_json;

// Every key that matters, by its full name. TOML's values, as the scene printer writes them, are JSON's too.
ordered_json scene_json(scene::Scene scene) {
    ordered_json keys = ordered_json::object();
    for (const scene::Section& section : scene::describe(scene)) {
        for (const scene::Key& key : section.keys) {
            if (key.matters) keys[key.full_name()] = ordered_json::parse(scene::value_text(key));
        }
    }
    return keys;
}

ordered_json part_json(const Part& part) {
    const film::Rect& w = part.window;
    return {{"file", part.file}, {"window", {w.x0, w.y0, w.x1, w.y1}}, {"scene", scene_json(part.scene)}};
}

}  // namespace

int scaled(int pixels, Size size) {
    switch (size) {
        case Size::small:
            return std::max(1, pixels / 2);
        case Size::large:
            return 2 * pixels;
        default:
            return pixels;
    }
}

std::span<const Figure> all_figures() {
    static const Figure figures[] = {kFigure1, kFigure2, kFigure3, kFigure4, kFigure5, kFigure6, kFigure7, kFigure8};
    return figures;
}

ordered_json record_of(const Plan& plan, Size size) {
    const std::string_view size_name = kSizeNames[static_cast<std::size_t>(size)];
    ordered_json shown = ordered_json::array(), parts = ordered_json::array(), comparisons = ordered_json::array();
    for (const Shown& file : plan.shown) shown.push_back({{"file", file.file}, {"alt", file.alt}});
    for (const Part& part : plan.parts) parts.push_back(part_json(part));
    for (const Comparison& pair : plan.comparisons) {
        comparisons.push_back({{"left", pair.left},
                               {"right", pair.right},
                               {"left_label", pair.left_label},
                               {"right_label", pair.right_label}});
    }
    return {{"figure", plan.number},
            {"title", plan.title},
            {"caption", plan.caption},
            {"chosen", plan.chosen},
            {"command", fmt::format("strata figures --only {} --size {}", plan.number, size_name)},
            {"size", size_name},
            {"version", STRATA_VERSION},
            {"simd_target", noise::simd_target()},
            {"shown", shown},
            {"data", plan.data},
            {"comparisons", comparisons},
            {"parameters", plan.parameters},
            {"parts", parts}};
}

void write_sheet(const Plan& plan, image::Sheet sheet, const std::filesystem::path& folder) {
    sheet.title = fmt::format("Figure {}. {}", plan.number, plan.title);
    sheet.caption = plan.caption;
    image::write_canvas(folder / plan.shown[0].file, image::compose(sheet));
}

scene::Scene builtin(std::string_view name) {
    const auto found = scene::find_builtin(name);
    if (!found) throw std::logic_error(fmt::format("no built-in scene '{}'", name));
    return scene::read_scene(found->text, found->name + ".toml");
}

}  // namespace strata::tools::figures
