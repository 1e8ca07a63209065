#include <doctest/doctest.h>

#include <hwy/highway.h>

#include <cstring>
#include <vector>

#include "src/render/render.h"
#include "tests/render/image_functions.h"

using namespace strata;
using namespace strata::estimate;
using namespace strata::film;
using namespace strata::render;
using namespace strata::render::testing;

TEST_CASE("sums of shared samples have the same bits on every SIMD target") {
    const auto image = busy();
    const Rect window{0, 0, 37, 23};
    for (const int m : {1, 2, 3, 4, 5, 8, 9, 31, 100}) {
        const Estimator estimator({scene::EstimatorKind::shared, 2, m, 1, 1, {}});
        std::vector<glm::vec3> expected;
        int targets = 0;
        for (std::int64_t rest = hwy::SupportedTargets() & HWY_TARGETS; rest != 0; rest &= rest - 1, ++targets) {
            hwy::GetChosenTarget().Update(rest & -rest);
            const RenderResult result = render::render(image, estimator, window);
            if (expected.empty()) expected = result.film.pixels();
            REQUIRE(std::memcmp(expected.data(), result.film.pixels().data(), expected.size() * sizeof(glm::vec3)) ==
                    0);
        }
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        MESSAGE("order ", m, ": ", targets, " targets agree");
    }
}
