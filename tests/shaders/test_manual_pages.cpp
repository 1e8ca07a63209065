// A shader's header is its manual page: the scene snippets in it must be scenes.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "src/scene/toml_reader.h"

namespace {

const std::filesystem::path kShaders = std::filesystem::path(STRATA_SOURCE_DIR) / "shaders_cpu";

// The indented comment lines from one that holds "[section]" to the next empty comment line.
std::string snippet(const std::string& header) {
    std::ifstream file(kShaders / header);
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
    std::vector<std::string> headers{"sky.h", "zoneplate.h", "checker.h", "wheel.h", "edge.h", "ramp.h", "constant.h"};
    for (const char* list : {"materials", "lights", "media", "backgrounds"}) {
        for (const auto& entry : std::filesystem::directory_iterator(kShaders / list)) {
            const std::string name = entry.path().filename().string();
            if (name.ends_with(".h") && name != "all.h") headers.push_back(std::string(list) + "/" + name);
        }
    }
    CHECK(headers.size() > 12);
    for (const std::string& header : headers) {
        CAPTURE(header);
        const std::string text = snippet(header);
        REQUIRE(!text.empty());
        CHECK_NOTHROW(strata::scene::read_scene(text, header));
    }
}

TEST_CASE("the material's snippet shows its defaults") {
    const strata::scene::Material shown =
        strata::scene::read_scene(snippet("materials/terrain.h"), "materials/terrain.h").material;
    const strata::scene::Material standard;
    CHECK(shown.low == standard.low);
    CHECK(shown.high == standard.high);
    CHECK(shown.steep == standard.steep);
    CHECK(shown.band_height == standard.band_height);
    CHECK(shown.band_width == standard.band_width);
    CHECK(shown.steep_deg == standard.steep_deg);
    CHECK(shown.steep_width_deg == standard.steep_width_deg);
}
