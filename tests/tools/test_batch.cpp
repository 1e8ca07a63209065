#include "tools/job/batch.h"

#include <doctest/doctest.h>

#include "src/image/write.h"
#include "src/scene/builtin.h"
#include "src/scene/toml_reader.h"
#include "tests/image/scratch_folder.h"
#include "tools/cli/errors.h"
#include "tools/job/already_there.h"

using namespace strata;
using namespace strata::tools::job;

namespace {

// A zone plate, which takes no time.
PictureJob small_job() {
    scene::Scene scene = scene::read_scene(scene::find_builtin("zoneplate")->text, "zoneplate");
    scene.film.width = 24;
    scene.film.height = 16;
    scene.sampling.N = 2;
    return {scene, {4, 2, 20, 14}};
}

}  // namespace

TEST_CASE("a batch renders the pixels that the job names, and they are those of the whole frame") {
    const parallel::CancelToken cancel;
    Batch batch(1, true, cancel);
    const PictureJob part = small_job(), frame = whole_frame(part.scene);
    for (const PictureJob& job : {part, frame}) batch.expect(job);
    const auto some = batch.render(part), all = batch.render(frame);
    REQUIRE((some && all));
    CHECK(some->picture.shape() == part.shape());
    for (int y = part.window.y0; y < part.window.y1; ++y) {
        for (int x = part.window.x0; x < part.window.x1; ++x) {
            const auto i = static_cast<std::size_t>((y - part.window.y0) * part.window.width() + x - part.window.x0);
            const auto k = static_cast<std::size_t>(y * frame.window.width() + x);
            CHECK(some->picture.rgb[3 * i] == all->picture.rgb[3 * k]);
        }
    }
}

TEST_CASE("a batch that is stopped gives no picture") {
    parallel::CancelToken cancel;
    cancel.request();
    Batch batch(1, true, cancel);
    CHECK(!batch.render(small_job()));
    CHECK(batch.is_stopped());
}

TEST_CASE("two pictures in a row without any file end a batch; one file of several is enough to go on") {
    const parallel::CancelToken cancel;
    Batch batch(1, true, cancel);
    const auto fails = [](const std::filesystem::path& path) {
        if (path == "bad") throw std::runtime_error("as this test wants it");
    };
    CHECK(!batch.write({"bad"}, fails));
    CHECK(batch.write({"bad", "good"}, fails));
    CHECK(!batch.write({"bad", "bad"}, fails));
    CHECK(!batch.is_failing());
    CHECK(!batch.write({"bad"}, fails));
    CHECK(batch.is_failing());
    CHECK(!batch.all_written());
}

TEST_CASE(
    "a job's float EXR is kept by the same job, made again by another, and refused where it may not be replaced") {
    const ScratchFolder folder;
    const auto path = folder / "a.exr";
    const PictureJob job = small_job();
    const auto kept = [&](const PictureJob& asked, IfOther other) {
        return is_kept(path, asked.metadata("float"), asked.shape(), other, true);
    };
    CHECK(!kept(job, IfOther::refuse));
    image::write_picture(path, render_picture(job, {}).picture, job.metadata("float"), job.float_exr());
    CHECK(kept(job, IfOther::refuse));
    PictureJob other = job;
    other.scene.sampling.seed += 1;
    CHECK(!kept(other, IfOther::replace));
    CHECK_THROWS_WITH_AS(kept(other, IfOther::refuse), doctest::Contains("seed"), tools::cli::UsageError);
}

TEST_CASE("a job's rays are its samples, one a pixel where nothing is antialiased") {
    PictureJob job = small_job();
    job.scene.sampling.N = 5;
    job.scene.sampling.estimator = scene::EstimatorKind::stratified;
    CHECK(job.expected_rays() == 16 * 12 * 25);
    job.scene.sampling.estimator = scene::EstimatorKind::none;
    CHECK(job.expected_rays() == 16 * 12);
}
