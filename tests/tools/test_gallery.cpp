#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "src/image/compare.h"
#include "src/scene/builtin.h"
#include "src/scene/toml_reader.h"
#include "tools/gallery/scales.h"
#include "tools/gallery/tiles.h"

using namespace strata;
using namespace strata::tools;
using namespace strata::tools::gallery;

namespace {

scene::Scene small_hills() {
    scene::Scene scene = scene::read_scene(scene::find_builtin("hills")->text, "hills");
    scene.film.width = 32;
    scene.film.height = 18;
    scene.sampling.N = 8;
    // Hits may lie a tolerance, in pixels, beyond the surface: as far at all scales.
    scene.sampling.tolerance = 0.001;
    return scene;
}

constexpr film::Rect kPlace{4, 4, 28, 16};  // skyline, lit and shaded slopes

image::Picture filled_picture(const film::Rect& window, int width, int height, auto value) {
    image::Picture picture{width, height, window.x0, window.y0, window.x1, window.y1, {}};
    for (int y = window.y0; y < window.y1; ++y)
        for (int x = window.x0; x < window.x1; ++x)
            for (int c = 0; c < 3; ++c) picture.rgb.push_back(static_cast<float>(value(x + 0.5, y + 0.5)));
    return picture;
}

}  // namespace

TEST_CASE("fine pixels add up to coarse ones: what is linear stays so, and where it is") {
    for (const int m : {1, 3, 5}) {
        for (const int k : {2, 3, 4, 7}) {
            CAPTURE(m);
            CAPTURE(k);
            const film::Rect place{3, 2, 6, 4};
            const film::Rect window = fine_window(place, k, m);
            const auto ramp = [&](double x, double y) { return 2.0 + 0.5 * x / k - 0.25 * y / k; };
            const image::Picture small = reduced(filled_picture(window, 9 * k, 8 * k, ramp), place, k, m);
            REQUIRE(small.width() == 3);
            REQUIRE(small.height() == 2);
            for (int y = 0; y < 2; ++y)
                for (int x = 0; x < 3; ++x) {
                    const float found = small.rgb[static_cast<std::size_t>(3 * (3 * y + x))];
                    CHECK(found == doctest::Approx(2.0 + 0.5 * (x + 3.5) - 0.25 * (y + 2.5)).epsilon(1e-6));
                }
        }
    }
}

TEST_CASE("a large picture made smaller is the small one, but for sampling") {
    parallel::CancelToken cancel;
    job::Batch batch(0, true, cancel);
    const scene::Scene scene = small_hills();
    const std::vector<Scale> scales = compare_scales(scene, kPlace, {1, 4, 32}, batch);
    REQUIRE(scales.size() == 3);
    CHECK(scales[2].width == 1024);
    for (const std::size_t i : {1u, 2u}) {
        const Scale& scale = scales[i];
        CAPTURE(scale.factor);
        MESSAGE("factor ", scale.factor, ": ", scale.difference, " found, ", scale.expected, " by sampling alone");
        // Of 288 pixels whose colours go together a root mean square is known to 4 %, and better than twice that where
        // few pixels at the skyline have most of the error; `expected` is one itself.
        CHECK(scale.difference < 1.3 * scale.expected);
        CHECK(scale.difference > 0.7 * scale.expected);
        // Half a coarse pixel beside the place it is another picture.
        image::Picture beside = scales[0].small;
        for (std::size_t p = 0; p + 3 < beside.rgb.size(); ++p)
            beside.rgb[p] = 0.5f * (beside.rgb[p] + beside.rgb[p + 3]);
        CHECK(image::compare(scale.small, beside).rmse > 2 * scale.expected);
    }
}

TEST_CASE("one thread and several make the same bits of a place in a large frame") {
    parallel::CancelToken cancel;
    job::Batch batch(2, true, cancel);
    const scene::Scene scene = small_hills();
    std::vector<Scale> scales = compare_scales(scene, {8, 6, 10, 8}, {32}, batch);
    REQUIRE(scales.size() == 1);
    CHECK(is_same_by_one_thread(scene, {8, 6, 10, 8}, scales[0], true, cancel) == true);
    scales[0].picture.rgb[7] = std::nextafter(scales[0].picture.rgb[7], 1.0f);
    CHECK(is_same_by_one_thread(scene, {8, 6, 10, 8}, scales[0], true, cancel) == false);
}

TEST_CASE("the gallery begins with the default scene and has those landscapes that are made to be hung") {
    const std::vector<std::string> names = gallery_scenes();
    REQUIRE(names.size() >= 7);
    CHECK(names.front() == scene::kDefaultScene);
    CHECK(std::ranges::is_sorted(names.begin() + 1, names.end()));
    for (const char* name : {"canyon", "dunes", "moon"}) CHECK(std::ranges::count(names, name) == 1);
    for (const char* name : {"hills", "wheel", "hyperterrain"}) CHECK(std::ranges::count(names, name) == 0);
}
