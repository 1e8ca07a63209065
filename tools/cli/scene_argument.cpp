#include "tools/cli/scene_argument.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>

#include "src/image/format.h"
#include "src/image/image_error.h"
#include "src/image/metadata.h"
#include "src/image/read.h"
#include "src/render/meter.h"
#include "src/scene/builtin.h"
#include "src/scene/enum_names.h"
#include "src/scene/key_text.h"
#include "src/scene/override.h"
#include "src/scene/scene_text.h"
#include "src/scene/suggest.h"
#include "src/scene/toml_reader.h"
#include "src/scene/typed_number.h"
#include "src/scene/validate.h"
#include "tools/cli/errors.h"
#include "tools/cli/shared_options.h"
#include "tools/cli/shell_word.h"
#include "tools/cli/standard_output.h"
#include "tools/cli/stream_input.h"

namespace strata::tools::cli {

namespace {

// Whole integers separated by one character; nothing else may stand in the text.
template <std::size_t kCount>
std::optional<std::array<int, kCount>> parse_integers(std::string_view text, char separator) {
    std::array<int, kCount> values{};
    for (std::size_t i = 0; i < kCount; ++i) {
        const std::size_t end = i + 1 < kCount ? text.find(separator) : text.size();
        if (end == std::string_view::npos) return std::nullopt;
        const auto value = scene::typed_integer<int>(text.substr(0, end));
        if (!value) return std::nullopt;
        values[i] = *value;
        text.remove_prefix(std::min(text.size(), end + 1));
    }
    return values;
}

struct Span {
    int begin, end;
};

// The part of `after` pixels that a span was of `before`: spans that touched still touch. One pixel at least.
Span scaled(const Span& span, int before, int after) {
    const auto at = [&](int x) {
        return static_cast<int>((2 * std::int64_t{x} * after + before) / (2 * std::int64_t{before}));
    };
    const int begin = std::min(at(span.begin), after - 1);
    return {begin, std::max(at(span.end), begin + 1)};
}

std::string unknown_scene(const std::string& name) {
    std::vector<std::string> names;
    for (const scene::BuiltinScene& builtin : scene::builtin_scenes()) names.push_back(builtin.name);
    std::string message = fmt::format("{}: no such file, and no built-in scene ({})",
                                      name.empty() ? "''" : scene::excerpt(name), fmt::join(names, ", "));
    if (const auto near = scene::nearest(name, names)) message += fmt::format(", did you mean '{}'?", *near);
    return message;
}

LoadedScene from_picture(const std::filesystem::path& path, const std::string& source) {
    const image::PictureFacts facts = image::read_facts(path);
    const image::Metadata& metadata = facts.metadata;
    const auto text = metadata.find(image::kSceneKey);
    if (!text) throw UsageError(source + ": this picture does not say how it was made: strata did not write it");
    // The scene may still be right, and is how the picture is made anew.
    if (facts.integrity == image::Integrity::damaged) {
        print_error(
            fmt::format("warning: {} is damaged: its bytes are not those that were written, and what it says of its "
                        "scene may be wrong",
                        source));
    }
    LoadedScene loaded;
    loaded.scene = scene::read_scene(*text, source);
    loaded.name = path.stem().string();
    // Rendered again, an interrupted picture becomes whole.
    constexpr std::string_view kPartial = ".partial";
    if (metadata.find("strata:partial") && loaded.name.ends_with(kPartial)) {
        loaded.name.resize(loaded.name.size() - kPartial.size());
    }
    loaded.crop = metadata.find("strata:crop");
    loaded.tracer = metadata.find("strata:tracer");
    loaded.exr_format = metadata.find("strata:format");
    loaded.aovs = metadata.find("strata:aov");
    loaded.layers = metadata.find("strata:layers");
    loaded.layer_prefix = metadata.find("strata:layer_prefix");
    loaded.is_tiled = metadata.find("strata:tiled").has_value();
    loaded.simd_target = metadata.find("strata:simd_target");
    loaded.passes = metadata.find("strata:passes");
    return loaded;
}

// Only .toml goes: a dot may be part of a name.
std::string name_of_file(const std::filesystem::path& path) {
    return (image::extension_of(path) == ".toml" ? path.stem() : path.filename()).string();
}

// Options that stand for a scene key. Their values go through the key's own reader, which knows what is allowed.
struct KeyOption {
    const char* names;
    const char* key;
    const char* type;
    const char* meaning;
};

constexpr std::array<KeyOption, 9> kKeyOptions{{
    {"-N,--samples", "sampling.N", "N", "Samples a side, N*N a pixel, 1 to 64"},
    {"-m,--order", "sampling.m", "M", "Order of the B-spline filter, 1 (box) to 100"},
    {"--estimator", "sampling.estimator", "NAME", "What places and weighs samples"},
    {"--seed", "sampling.seed", "S", "Seed of the sample positions, 0 or more"},
    {"--time-order", "sampling.time_order", "L", "Order of the B-spline filter in time, 1 to 100"},
    {"--frame", "shutter.frame", "K", "Number of the frame, from 0"},
    {"--fps", "shutter.fps", "RATE", "Frames a second; a fraction, too: 24000/1001"},
    {"--exposure", "film.exposure", "STOPS", "Brightening of PNG, TIFF and JPEG in stops, -64 to 64"},
    {"--tone", "film.tone", "NAME", "Tone curve of PNG, TIFF and JPEG: none, reinhard or agx"},
}};

// With the names that it may have, if those are few.
std::string meaning_of(const KeyOption& option) {
    if (option.key != std::string_view("sampling.estimator")) return option.meaning;
    return fmt::format("{}: {}", option.meaning, fmt::join(scene::kEnumNames<scene::EstimatorKind>, ", "));
}

}  // namespace

void SceneArgument::add_changes(Command& command) {
    command
        .add_option("--set", sets_, "KEY=VALUE",
                    "Replace any scene key: --set camera.fov_deg=35 (a TOML value, words without quotes; may be "
                    "repeated; `strata scenes NAME` explains the keys)")
        ->repeated();
    command.add_option("--size", size_, "WxH",
                       "Frame in pixels, 1 to 65536 a side; default the scene's film.width, film.height");
}

SceneArgument SceneArgument::of(std::string scene) const {
    SceneArgument other = *this;
    other.scene_ = std::move(scene);
    return other;
}

std::string SceneArgument::typed_changes() const {
    std::string text;
    for (const std::string& set : sets_) text += " --set " + shell_word(set);
    if (size_) text += " --size " + shell_word(*size_);
    for (std::size_t i = 0; i < key_values_.size(); ++i) {
        const std::string_view names = kKeyOptions[i].names;
        if (key_values_[i])
            text += fmt::format(" {} {}", names.substr(0, names.find(',')), shell_word(*key_values_[i]));
    }
    return text;
}

bool SceneArgument::size_given() const {
    return size_ || std::ranges::any_of(sets_, [](const std::string& set) {
               const std::size_t start = std::min(set.find_first_not_of(" \t"), set.size());
               return set.compare(start, 10, "film.width") == 0 || set.compare(start, 11, "film.height") == 0;
           });
}

void SceneArgument::add_scene_to(Command& command, const std::string& description) {
    command.add_option("SCENE", scene_, "", description)->required();
    add_changes(command);
}

void SceneArgument::add_to(Command& command, const char* name, std::span<const std::string_view> own) {
    command
        .add_option(
            name, scene_, "",
            "A scene file, a built-in scene (`strata scenes`), or a picture that strata wrote; - reads standard input")
        ->capture_default_str();
    add_changes(command);
    key_values_.resize(kKeyOptions.size());
    for (std::size_t i = 0; i < kKeyOptions.size(); ++i) {
        const KeyOption& option = kKeyOptions[i];
        if (std::ranges::find(own, option.key) != own.end()) continue;
        command.add_option(option.names, key_values_[i], option.type,
                           fmt::format("{}; default the scene's {}", meaning_of(option), option.key));
    }
}

LoadedScene SceneArgument::find() const {
    const auto spooled = spool_stream(scene_);
    const std::filesystem::path path = spooled.value_or(scene_);
    const std::string source = scene_ == "-" ? "standard input" : scene_;
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    const bool exists = std::filesystem::exists(status);
    LoadedScene loaded;
    // A folder of that name does not hide a built-in scene.
    const auto builtin = scene::find_builtin(scene_);
    if (builtin && (!exists || std::filesystem::is_directory(status))) {
        loaded.scene = scene::read_scene(builtin->text, builtin->name);
        loaded.name = builtin->name;
    } else if (!exists && path.filename() == path && !path.has_extension()) {
        throw UsageError(unknown_scene(scene_));
    } else if (image::is_picture(path)) {
        loaded = from_picture(path, source);
    } else {
        loaded.scene = scene::read_scene(scene::file_text(path.string()), source);
        loaded.name = name_of_file(path);
    }
    if (spooled) loaded.name = "stdin";
    loaded.source = source;
    return loaded;
}

LoadedScene SceneArgument::load() const {
    LoadedScene loaded;
    try {
        loaded = find();
    } catch (const image::ImageError& error) {
        throw UsageError(error.what());
    }
    scene::Scene& scene = loaded.scene;
    loaded.recorded_film = scene.film;
    for (const std::string& assignment : sets_) scene::apply_override(scene, assignment);
    if (size_) {
        const auto size = parse_integers<2>(*size_, 'x');
        if (!size)
            throw UsageError(fmt::format("--size {}: allowed: WIDTHxHEIGHT, such as 1280x720", scene::excerpt(*size_)));
        const std::string typed = "--size " + *size_;
        scene::apply_override(scene, fmt::format("film.width={}", (*size)[0]), typed);
        scene::apply_override(scene, fmt::format("film.height={}", (*size)[1]), typed);
    }
    // None where a command took the scene alone.
    for (std::size_t i = 0; i < key_values_.size(); ++i) {
        if (!key_values_[i]) continue;
        scene::apply_override(scene, fmt::format("{}={}", kKeyOptions[i].key, *key_values_[i]),
                              fmt::format("{} {}", shown_name(kKeyOptions[i].names), scene::excerpt(*key_values_[i])));
    }
    scene::validate(scene, loaded.source);
    render::take_exposure(scene);
    return loaded;
}

film::Rect parse_crop(const std::string& origin, const std::string& text, const scene::Film& film) {
    const auto c = parse_integers<4>(text, ',');
    const bool inside = c && 0 <= (*c)[0] && (*c)[0] < (*c)[2] && (*c)[2] <= film.width && 0 <= (*c)[1] &&
                        (*c)[1] < (*c)[3] && (*c)[3] <= film.height;
    if (!inside) {
        throw UsageError(fmt::format("{} {}: allowed: x0,y0,x1,y1 with 0 <= x0 < x1 <= {} and 0 <= y0 < y1 <= {}",
                                     origin, scene::excerpt(text), film.width, film.height));
    }
    return {(*c)[0], (*c)[1], (*c)[2], (*c)[3]};
}

film::Rect window_of(const std::string& crop, const LoadedScene& loaded) {
    const scene::Film& film = loaded.scene.film;
    if (!crop.empty()) return parse_crop("--crop", crop, film);
    if (!loaded.crop) return {0, 0, film.width, film.height};
    const scene::Film& before = loaded.recorded_film;
    const film::Rect w = parse_crop(loaded.source + ": its --crop", *loaded.crop, before);
    const Span across = scaled({w.x0, w.x1}, before.width, film.width);
    const Span down = scaled({w.y0, w.y1}, before.height, film.height);
    return {across.begin, down.begin, across.end, down.end};
}

integrate::Tracer tracer_of(const std::optional<integrate::Tracer>& given, const LoadedScene& loaded) {
    return given ? *given : parse_tracer(loaded.tracer.value_or("fast"));
}

glm::ivec2 parse_pixel(const std::string& text, const scene::Film& film) {
    const auto p = parse_integers<2>(text, ',');
    if (!p || (*p)[0] < 0 || (*p)[0] >= film.width || (*p)[1] < 0 || (*p)[1] >= film.height) {
        throw UsageError(fmt::format("--pixel {}: allowed: x,y with 0 <= x < {} and 0 <= y < {}", scene::excerpt(text),
                                     film.width, film.height));
    }
    return {(*p)[0], (*p)[1]};
}

}  // namespace strata::tools::cli
