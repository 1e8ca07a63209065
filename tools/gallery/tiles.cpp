#include "tools/gallery/tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/image/colour_out.h"
#include "src/scene/builtin.h"
#include "src/scene/override.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"
#include "tools/cli/errors.h"

namespace strata::tools::gallery {

namespace {

bool is_to_be_hung(const scene::BuiltinScene& builtin) {
    const scene::Scene scene = scene::read_scene(builtin.text, builtin.name);
    return scene.image == scene::ImageKind::surface && scene.film.tone != scene::ToneCurve::none;
}

job::FolderPicture picture_of(const scene::Scene& scene, std::string file) {
    const job::PictureJob job = job::whole_frame(scene);
    return {job, std::move(file), job.metadata("half"), {.colour = image::colour_out(scene.film)}};
}

job::FolderPicture small_picture(scene::Scene scene, std::string file) {
    const int width = std::min(kSmallWidth, scene.film.width);
    const double height = std::round(1.0 * width * scene.film.height / scene.film.width);
    scene.film.width = width;
    scene.film.height = std::max(1, static_cast<int>(height));
    return picture_of(scene, std::move(file));
}

}  // namespace

std::vector<std::string> gallery_scenes() {
    std::vector<std::string> names;
    for (const scene::BuiltinScene& builtin : scene::builtin_scenes())
        if (is_to_be_hung(builtin)) names.push_back(builtin.name);
    std::stable_partition(names.begin(), names.end(),
                          [](const std::string& name) { return name == scene::kDefaultScene; });
    return names;
}

std::vector<Tile> tiles_of_scenes(const std::vector<std::string>& names, const cli::SceneArgument& changes) {
    std::vector<Tile> tiles;
    for (const std::string& name : names) {
        scene::Scene scene = changes.of(name).load().scene;
        const std::string size = changes.size_given() ? "" : " --size 1920x1080";
        if (!changes.size_given()) {
            scene.film.width = 1920;
            scene.film.height = 1080;
        }
        tiles.push_back(
            {.name = name,
             .title = scene.title,
             .command = fmt::format("strata render {}{}{} -o {}.jpg", name, size, changes.typed_changes(), name),
             .small = small_picture(scene, name + "-small.jpg"),
             .large = picture_of(scene, name + ".jpg")});
    }
    return tiles;
}

std::vector<Tile> tiles_of_variants(const cli::SceneArgument& argument, const std::string& key,
                                    const animate::FrameList& values) {
    if (values.count() > kMostVariants)
        throw cli::UsageError(fmt::format("--seeds: {} variants, allowed: up to {}", values.count(), kMostVariants));
    const cli::LoadedScene loaded = argument.load();
    const std::string varied = !key.empty()                          ? key
                               : loaded.scene.surface.relief.empty() ? "surface.seed"
                                                                     : "relief.seed";
    std::vector<Tile> tiles;
    for (const int value : values) {
        const std::string setting = fmt::format("{}={}", varied, value);
        scene::Scene scene = loaded.scene;
        scene::apply_override(scene, setting, fmt::format("--key {}, --seeds {}", varied, value));
        scene::validate(scene, setting);
        tiles.push_back(
            {.name = loaded.name,
             .title = scene.title,
             .command = fmt::format("strata render {}{} --set {}", loaded.source, argument.typed_changes(), setting),
             .small = small_picture(scene, fmt::format("{}-{}-{}.jpg", loaded.name, varied, value)),
             .large = std::nullopt});
    }
    return tiles;
}

}  // namespace strata::tools::gallery
