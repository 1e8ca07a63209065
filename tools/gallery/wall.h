// What is made of a gallery's pictures when they are there: a wall of the small ones, and a page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/image/canvas.h"
#include "tools/gallery/tiles.h"
#include "tools/job/ledger.h"

namespace strata::tools::gallery {

// The small pictures, which lie in the folder, in rows: of scenes with their names, of variants with their commands.
image::Canvas draw_wall(const std::filesystem::path& folder, const std::vector<Tile>& tiles, const std::string& title);

// A page of all tiles, each with its caption, its command, and, as far as the ledger knows, what it cost.
std::string page_of(const std::vector<Tile>& tiles, const job::Ledger& ledger, const std::string& title,
                    const std::string& introduction);

}  // namespace strata::tools::gallery
