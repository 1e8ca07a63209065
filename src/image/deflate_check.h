// What a TIFF tells about damage of its own pixels: the checksum that ends each deflated strip or tile. Private to
// src/image.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace strata::image {

// What is wrong with the first strip or tile that does not inflate to its end, as "strip 3 of 8 is damaged"; nothing
// when all do, and for other compressions, which have no checksum. OpenImageIO does not look at it.
std::optional<std::string> find_deflate_damage(const std::filesystem::path& tiff);

}  // namespace strata::image
