#include "src/scene/rate.h"

#include <doctest/doctest.h>

#include "src/scene/override.h"
#include "src/scene/printer.h"
#include "src/scene/scene_error.h"
#include "src/scene/toml_reader.h"

using namespace strata::scene;

TEST_CASE("frame times of a fraction are the doubles next to the exact ones, far out too") {
    const Rate film = *parse_fraction("24000/1001");
    for (const long long frame : {1LL, 7LL, 24'000LL, 999'999'999LL}) {
        const long double exact = static_cast<long double>(frame) * 1001 / 24000;
        CHECK(film.seconds(static_cast<double>(frame)) == static_cast<double>(exact));
    }
    CHECK(film.seconds(24000) == 1001.0);
    CHECK(Rate(25.0).seconds(7) == 7 / 25.0);
    CHECK(film.every(2).text() == "24000/2002");
}

TEST_CASE("a fraction is in lowest terms; what is none is refused") {
    CHECK(parse_fraction("48000/2002")->text() == "24000/1001");
    CHECK(parse_fraction("50/2")->text() == "25.0");
    for (const char* bad : {"", "/", "24", "1/0", "0/1", "-1/2", "1/2/3", "1.5/2", " 1/2", "2000000/1"}) {
        CAPTURE(bad);
        CHECK(!parse_fraction(bad));
    }
}

TEST_CASE("shutter.fps takes a fraction and is printed as it is read") {
    Scene scene;
    apply_override(scene, "shutter.fps=24000/1001");
    CHECK(scene.shutter.fps.text() == "24000/1001");
    CHECK(print_scene(scene, PrintedKeys::all).find("fps = \"24000/1001\"") != std::string::npos);
    const Scene again = read_scene(print_scene(scene, PrintedKeys::all), "again");
    CHECK(again.shutter.fps.text() == "24000/1001");
    scene.shutter.frame = 24000;
    CHECK(scene.shutter.time_s() == 1001.0);
    for (const char* bad : {"24000/x", "\"1/0\"", "1/1000000", "\"24\""}) {
        CAPTURE(bad);
        CHECK_THROWS_WITH_AS(apply_override(scene, std::string("shutter.fps=") + bad), doctest::Contains("shutter.fps"),
                             SceneError);
    }
}
