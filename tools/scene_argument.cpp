#include "tools/scene_argument.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <charconv>
#include <filesystem>

#include "noise/simd_target.h"
#include "src/image/metadata.h"
#include "src/image/read.h"
#include "src/scene/builtin.h"
#include "src/scene/override.h"
#include "src/scene/suggest.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"
#include "tools/errors.h"

namespace strata::tools {

namespace {

// Whole integers separated by one character; nothing else may stand in the text.
template <std::size_t kCount>
std::optional<std::array<int, kCount>> parse_integers(std::string_view text, char separator) {
    std::array<int, kCount> values{};
    for (std::size_t i = 0; i < kCount; ++i) {
        const std::size_t end = i + 1 < kCount ? text.find(separator) : text.size();
        if (end == std::string_view::npos) return std::nullopt;
        const auto [rest, error] = std::from_chars(text.data(), text.data() + end, values[i]);
        if (error != std::errc() || rest != text.data() + end || end == 0) return std::nullopt;
        text.remove_prefix(std::min(text.size(), end + 1));
    }
    return values;
}

std::string unknown_scene(const std::string& name) {
    std::vector<std::string> names;
    for (const scene::BuiltinScene& builtin : scene::builtin_scenes()) names.push_back(builtin.name);
    std::string message = fmt::format("{}: no such file, and no built-in scene ({})", name, fmt::join(names, ", "));
    if (const auto near = scene::nearest(name, names)) message += fmt::format("; did you mean '{}'?", *near);
    return message;
}

LoadedScene from_picture(const std::filesystem::path& path) {
    const auto text = image::read_metadata(path, image::kSceneKey);
    if (!text) throw UsageError(path.string() + ": this picture does not say how it was made: strata did not write it");
    LoadedScene loaded;
    loaded.scene = scene::read_scene(*text, path.string());
    loaded.crop = image::read_metadata(path, "strata:crop");
    loaded.tracer = image::read_metadata(path, "strata:tracer");
    loaded.exr_format = image::read_metadata(path, "strata:format");
    return loaded;
}

}  // namespace

void SceneArgument::add_to(CLI::App& command) {
    command
        .add_option("SCENE", scene_, "A scene file, a built-in scene (`strata scenes`), or a picture that strata wrote")
        ->capture_default_str();
    command.add_option("--set", sets_, "Replace a scene key: --set camera.fov_deg=35 (TOML; may be repeated)")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_option("--size", size_, "Frame in pixels: film.width and film.height")->type_name("WxH");
    command.add_option("-N,--samples", N_, "Samples a side, N*N a pixel: sampling.N")->type_name("N");
    command.add_option("-m,--order", m_, "Order of the B-spline filter: sampling.m")->type_name("M");
    command
        .add_option("--estimator", estimator_,
                    "none, super, uniform, jittered, stratified, random, sobol, shared, "
                    "shared-sobol: sampling.estimator")
        ->type_name("NAME");
    command.add_option("--seed", seed_, "sampling.seed")->type_name("S");
    command.add_option("--time-order", time_order_, "Order of the B-spline in time: sampling.time_order")
        ->type_name("L");
    command.add_option("--frame", frame_, "shutter.frame, from 0")->type_name("K");
    command.add_option("--exposure", exposure_, "Stops, for PNG, TIFF and JPEG: film.exposure")->type_name("STOPS");
}

LoadedScene SceneArgument::find() const {
    const std::filesystem::path path(scene_);
    LoadedScene loaded;
    if (const auto builtin = scene::find_builtin(scene_); builtin && !std::filesystem::exists(path)) {
        loaded.scene = scene::read_scene(builtin->text, builtin->name);
        loaded.name = builtin->name;
    } else if (!std::filesystem::exists(path) && path.filename() == path && !path.has_extension()) {
        throw UsageError(unknown_scene(scene_));
    } else if (image::is_picture(path)) {
        loaded = from_picture(path);
        loaded.name = path.stem().string();
    } else {
        loaded.scene = scene::load_scene(scene_);
        loaded.name = path.stem().string();
    }
    loaded.source = scene_;
    return loaded;
}

LoadedScene SceneArgument::load() const {
    LoadedScene loaded = find();
    scene::Scene& scene = loaded.scene;
    for (const std::string& assignment : sets_) scene::apply_override(scene, assignment);
    const auto set = [&scene](const char* key, const auto& value, const char* option) {
        if (value)
            scene::apply_override(scene, fmt::format("{}={}", key, *value), fmt::format("{} {}", option, *value));
    };
    if (size_) {
        const auto size = parse_integers<2>(*size_, 'x');
        if (!size) throw UsageError(fmt::format("--size {}: allowed: WIDTHxHEIGHT, such as 1280x720", *size_));
        set("film.width", std::optional((*size)[0]), "--size width");
        set("film.height", std::optional((*size)[1]), "--size height");
    }
    set("sampling.N", N_, "-N");
    set("sampling.m", m_, "-m");
    set("sampling.estimator", estimator_, "--estimator");
    set("sampling.seed", seed_, "--seed");
    set("sampling.time_order", time_order_, "--time-order");
    set("shutter.frame", frame_, "--frame");
    set("film.exposure", exposure_, "--exposure");
    scene::validate(scene, loaded.source);
    return loaded;
}

render::Window parse_crop(const std::string& text, const scene::Film& film) {
    const auto c = parse_integers<4>(text, ',');
    const bool inside = c && 0 <= (*c)[0] && (*c)[0] < (*c)[2] && (*c)[2] <= film.width && 0 <= (*c)[1] &&
                        (*c)[1] < (*c)[3] && (*c)[3] <= film.height;
    if (!inside) {
        throw UsageError(fmt::format("--crop {}: allowed: x0,y0,x1,y1 with 0 <= x0 < x1 <= {} and 0 <= y0 < y1 <= {}",
                                     text, film.width, film.height));
    }
    return {(*c)[0], (*c)[1], (*c)[2], (*c)[3]};
}

glm::ivec2 parse_pixel(const std::string& text, const scene::Film& film) {
    const auto p = parse_integers<2>(text, ',');
    if (!p || (*p)[0] < 0 || (*p)[0] >= film.width || (*p)[1] < 0 || (*p)[1] >= film.height) {
        throw UsageError(
            fmt::format("--pixel {}: allowed: x,y with 0 <= x < {} and 0 <= y < {}", text, film.width, film.height));
    }
    return {(*p)[0], (*p)[1]};
}

render::Tracer parse_tracer(const std::string& name) {
    if (name == "fast") return render::Tracer::fast;
    if (name == "reference") return render::Tracer::reference;
    throw UsageError(fmt::format("--tracer {}: allowed: fast, reference", name));
}

void use_simd_target(const std::string& name) {
    if (noise::pin_simd_target(name)) return;
    throw UsageError(
        fmt::format("--simd {}: allowed on this machine: {}", name, fmt::join(noise::simd_targets(), ", ")));
}

}  // namespace strata::tools
