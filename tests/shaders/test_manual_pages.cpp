// A shader's header is its manual page: the scene snippets in it must be scenes.
#include <doctest/doctest.h>

#include <fstream>
#include <string>

#include "src/scene/toml_reader.h"

namespace {

// The indented comment lines from one that holds "[section]" to the next empty comment line.
std::string snippet(const std::string& header) {
    std::ifstream file(std::string(STRATA_SOURCE_DIR) + "/shaders_cpu/" + header);
    const std::string indent = "//   ";
    std::string text;
    for (std::string line; std::getline(file, line);) {
        if (!text.empty() && !line.starts_with(indent)) break;
        if (!text.empty() || line.starts_with(indent + "[")) text += line.substr(indent.size()) + '\n';
    }
    return text;
}

}  // namespace

TEST_CASE("the scene snippet of every shader's header is a valid scene") {
    for (const char* header :
         {"sky.h", "terrain_material.h", "zoneplate.h", "checker.h", "wheel.h", "edge.h", "ramp.h", "constant.h"}) {
        CAPTURE(header);
        const std::string text = snippet(header);
        REQUIRE(!text.empty());
        CHECK_NOTHROW(strata::scene::read_scene(text, header));
    }
}

TEST_CASE("the material's snippet shows its defaults") {
    const strata::scene::Material shown =
        strata::scene::read_scene(snippet("terrain_material.h"), "terrain_material.h").material;
    const strata::scene::Material standard;
    CHECK(shown.low == standard.low);
    CHECK(shown.high == standard.high);
    CHECK(shown.steep == standard.steep);
    CHECK(shown.band_height == standard.band_height);
    CHECK(shown.band_width == standard.band_width);
    CHECK(shown.steep_deg == standard.steep_deg);
    CHECK(shown.steep_width_deg == standard.steep_width_deg);
}
