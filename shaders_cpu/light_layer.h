#pragma once

namespace strata::shaders {

// The layer of a picture in which light shows; `bounce` is what other ground reflects
// (src/integrate/channel_table.cpp).
enum class LightLayer { sun, sky, bounce };

}  // namespace strata::shaders
