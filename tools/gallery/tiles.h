// The pictures of a gallery: of each scene one to look at and a small one, or a small one of each variant of a scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/animate/range.h"
#include "tools/cli/scene_argument.h"
#include "tools/job/picture_folder.h"

namespace strata::tools::gallery {

// A picture of a wall: what stands under it, and the commands that make it.
struct Tile {
    std::string name;     // of the scene
    std::string title;    // of the scene
    std::string command;  // that makes it
    job::FolderPicture small;
    std::optional<job::FolderPicture> large;
};

inline constexpr int kSmallWidth = 400;  // pixels, or the frame's; the height in its proportion
inline constexpr int kMostVariants = 400;

// The scenes of the gallery: those that picture a surface through a tone curve, as is done for pictures to be hung. The
// default scene first, then a to z.
std::vector<std::string> gallery_scenes();

// Of these scenes, with the changes: large pictures of 1920x1080 unless --size is given.
std::vector<Tile> tiles_of_scenes(const std::vector<std::string>& names, const cli::SceneArgument& changes);

// One scene, with a key set to each value in turn. Empty key: what chooses another place of the same kind, the seeds of
// all relief terms or, where there are none, of the noise. Throws SceneError and UsageError.
std::vector<Tile> tiles_of_variants(const cli::SceneArgument& argument, const std::string& key,
                                    const animate::FrameList& values);

}  // namespace strata::tools::gallery
