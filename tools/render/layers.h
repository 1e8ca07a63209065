// The channels beside colour of a render that the command line asks for.
#pragma once

#include <vector>

#include "src/image/metadata.h"
#include "tools/render/job.h"

namespace strata::tools::render {

// What --aov, --layers and --layer-prefix say, or the picture that is rendered again recorded. Throws UsageError.
void choose_aovs(const RenderRequest& request, Job& job);

// Files of their own, once the outputs are known. Throws UsageError for channels that have no place, and ImageError for
// files that cannot be written.
void choose_layer_files(Job& job);

// Those of which pictures in false colour are drawn.
std::vector<const integrate::Channel*> drawn_aovs(const Job& job);

// What a picture says of its other channels: which there are, how each is filtered, and what is needed to make them
// again.
void set_aovs(const Job& job, image::Metadata& metadata);

}  // namespace strata::tools::render
