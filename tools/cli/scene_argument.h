// The SCENE argument and the options that change a scene, as every subcommand takes them.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src/film/film.h"
#include "src/integrate/surface_image.h"
#include "src/scene/builtin.h"
#include "src/scene/scene.h"
#include "tools/cli/command_line.h"

namespace strata::tools::cli {

// A scene and what a picture's metadata adds to it.
struct LoadedScene {
    scene::Scene scene;
    std::string name;    // of output files: the file's or built-in scene's, without folder and extension
    std::string source;  // for messages
    std::optional<std::string> crop, tracer, exr_format, simd_target, passes, aovs, layers,
        layer_prefix;  // as recorded in a picture
    bool is_tiled = false;
    scene::Film recorded_film;  // of the scene before --set and --size: what `crop` refers to
};

class SceneArgument {
  public:
    SceneArgument() = default;

    // As if it had been typed, and nothing else.
    explicit SceneArgument(std::string scene) : scene_(std::move(scene)) {}

    // Adds SCENE, --set and the options that stand for scene keys. A name such as "--scene" makes SCENE an option.
    // Keys in `own` get no option: the command has its own for them.
    void add_to(Command& command, const char* name = "SCENE", std::span<const std::string_view> own = {});

    // Adds SCENE, which must be given, --set and --size alone: for commands that choose N, m, estimator and seeds.
    void add_scene_to(Command& command, const std::string& description);

    // The same changes of another scene.
    SceneArgument of(std::string scene) const;

    // --set, --size and the options that stand for scene keys, as they may be typed again: each after a blank.
    std::string typed_changes() const;

    // Whether --size or --set says how large the frame is.
    bool size_given() const;

    // A path, a built-in scene's name, or a picture that strata wrote; overrides applied, validated. Throws SceneError
    // or UsageError.
    LoadedScene load() const;

  private:
    LoadedScene find() const;
    void add_changes(Command& command);

    std::string scene_{scene::kDefaultScene};
    std::optional<std::string> size_;
    std::vector<std::string> sets_;
    std::vector<std::optional<std::string>> key_values_;  // one a KeyOption, as typed
};

// "x0,y0,x1,y1", half-open, inside the frame. origin is what the text was given to, for the message. Throws UsageError.
film::Rect parse_crop(const std::string& origin, const std::string& text, const scene::Film& film);

// What is rendered of the frame: the crop of --crop, empty if not given; else the one that the picture recorded, which
// shows the same part of a frame of another size; else all. Throws UsageError.
film::Rect window_of(const std::string& crop, const LoadedScene& loaded);

// --tracer if given; else the one that the picture recorded; else fast. Throws UsageError.
integrate::Tracer tracer_of(const std::optional<integrate::Tracer>& given, const LoadedScene& loaded);

// "x,y" inside the frame. Throws UsageError.
glm::ivec2 parse_pixel(const std::string& text, const scene::Film& film);

}  // namespace strata::tools::cli
