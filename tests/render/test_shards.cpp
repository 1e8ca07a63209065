#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "src/render/progressive.h"
#include "tests/render/image_functions.h"

using namespace strata;
using namespace strata::estimate;
using namespace strata::film;
using namespace strata::render;

namespace {

EstimatorSettings settings_of(scene::EstimatorKind kind) {
    EstimatorSettings settings;
    settings.kind = kind;
    settings.N = 2;
    settings.m = 4;
    return settings;
}

// The window put together from parts, in strips of the rows that shards are rendered by.
Film merged(const Rect& window, int count, const auto& render_part) {
    Film whole(window);
    for (int number = 1; number <= count; ++number) {
        const ShardPicture shard(window, {number, count});
        const Film part = render_part(shard);
        CHECK(part.window() == shard.window());
        CHECK(part.complete());
        CHECK(std::ranges::all_of(part.pixels(), [](const glm::vec3& pixel) { return std::isfinite(pixel.r); }));
        for (std::int64_t i = 0; i < shard.slots(); ++i) {
            const Rect block = shard.block(i), slot = shard.slot(i);
            for (int y = block.y0; y < block.y1; ++y) {
                for (int x = block.x0; x < block.x1; ++x) {
                    whole.finish(x, y, part.at(x - block.x0 + slot.x0, y - block.y0 + slot.y0));
                }
            }
        }
    }
    return whole;
}

bool same_bits(const Film& a, const Film& b) {
    return std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size() * sizeof(glm::vec3)) == 0;
}

}  // namespace

TEST_CASE("the shards of a picture hold its very pixels, whatever their number, the estimator and the threads") {
    const auto image = testing::busy();
    const Rect window{-3, 5, 200, 321};
    for (const scene::EstimatorKind kind :
         {scene::EstimatorKind::none, scene::EstimatorKind::jittered, scene::EstimatorKind::shared}) {
        const Estimator estimator(settings_of(kind));
        const Film whole = render::render(image, estimator, window, {}).film;
        for (const int count : {1, 2, 5, 20}) {
            const Film together = merged(window, count, [&](const ShardPicture& shard) {
                RenderOptions options;
                options.threads = 1 + count % 3;
                options.tile = 7 * count;
                options.shard = &shard;
                return render::render(image, estimator, shard.window(), options).film;
            });
            CHECK(together.complete());
            CHECK(same_bits(together, whole));
        }
    }
}

TEST_CASE("the shards of a picture of several passes hold its very pixels") {
    const auto image = testing::busy();
    const Rect window{0, 0, 150, 130};
    const EstimatorSettings settings = settings_of(scene::EstimatorKind::jittered);
    const PassGoal goal{.passes = 3};
    const Film whole = render_progressively(image, settings, window, goal).render.film;
    const Film together = merged(window, 4, [&](const ShardPicture& shard) {
        RenderOptions options;
        options.shard = &shard;
        return render_progressively(image, settings, shard.window(), goal, options).render.film;
    });
    CHECK(same_bits(together, whole));
}

TEST_CASE("another window than the shard's is refused") {
    const auto image = testing::busy();
    const ShardPicture shard({0, 0, 100, 100}, {1, 2});
    RenderOptions options;
    options.shard = &shard;
    CHECK_THROWS_AS(
        render::render(image, Estimator(settings_of(scene::EstimatorKind::none)), {0, 0, 100, 100}, options),
        std::invalid_argument);
}
