// What layers of ground cover, in files: read by another library, and against a picture that is white where one lies.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <map>

#include "src/image/openimageio.h"
#include "src/image/picture_stream.h"
#include "src/integrate/cryptomatte.h"
#include "src/integrate/make_image.h"
#include "src/render/render.h"
#include "src/scene/builtin.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"
#include "tests/image/scratch_folder.h"
#include "tools/job/aov.h"

using namespace strata;
using namespace strata::tools;

namespace {

const std::string kLayers = R"([[ground]]
name = "rock"
[[ground]]
name = "grass"
slope_to_deg = 30.0
slope_noise_deg = 5.0
cover = 0.9
[[ground]]
name = "snow"
height_from = 0.4
height_noise = 0.1
noise_size = 0.5
)";
const std::vector<std::string> kNames{"rock", "grass", "snow"};

constexpr scene::EstimatorKind kKinds[] = {scene::EstimatorKind::none,       scene::EstimatorKind::super,
                                           scene::EstimatorKind::stratified, scene::EstimatorKind::random,
                                           scene::EstimatorKind::shared,     scene::EstimatorKind::shared_sobol};

scene::Scene mountains(scene::EstimatorKind kind) {
    scene::Scene scene = scene::read_scene(std::string(scene::find_builtin("terrain")->text) + kLayers, "here");
    scene.film.width = 40;
    scene.film.height = 70;
    scene.sampling.estimator = kind;
    scene.sampling.N = kind == scene::EstimatorKind::none ? 1 : 3;
    scene::validate(scene);
    return scene;
}

integrate::ChannelSet channels_of(const scene::Scene& scene, const std::string& names) {
    return job::parse_aovs(names, estimate::estimator_settings(scene), scene::names_of(scene.ground));
}

render::RenderResult render_with(const scene::Scene& scene, const integrate::ChannelSet& channels, int tile = 16) {
    render::RenderOptions options;
    options.threads = 1;
    options.tile = tile;
    options.channels = channels;
    return render::render(*integrate::make_image(scene), estimate::Estimator(estimate::estimator_settings(scene)),
                          {0, 0, scene.film.width, scene.film.height}, options);
}

// A file as another program sees it.
struct Read {
    OIIO::ImageSpec spec;
    std::vector<float> values;

    float at(std::size_t pixel, const std::string& channel) const {
        const int index = spec.channelindex(channel);
        REQUIRE(index >= 0);
        return values[pixel * static_cast<std::size_t>(spec.nchannels) + static_cast<std::size_t>(index)];
    }
    std::size_t pixels() const { return values.size() / static_cast<std::size_t>(spec.nchannels); }
};

Read write_and_read(const scene::Scene& scene, const std::string& names) {
    const ScratchFolder folder;
    const integrate::ChannelSet channels = channels_of(scene, names);
    const render::RenderResult result = render_with(scene, channels);
    image::WriteOptions options;
    options.exr_extra = job::aov_channels(channels);
    options.exr_attributes = job::aov_header(channels);
    const image::PictureShape shape{scene.film.width, scene.film.height, 0, 0, scene.film.width, scene.film.height};
    image::PictureStream stream(folder / "mattes.exr", shape, {}, options);
    const auto width = static_cast<std::size_t>(scene.film.width), of_pixel = channels.values();
    for (int y = 0; y < scene.film.height; y += image::kStripRows) {
        const auto rows = static_cast<std::size_t>(std::min(image::kStripRows, scene.film.height - y));
        const std::size_t first = static_cast<std::size_t>(y) * width;
        stream.write({&result.film.pixels()[first].x, 3 * rows * width},
                     std::span(result.film.channels()).subspan(first * of_pixel, rows * width * of_pixel));
    }
    stream.finish();
    const auto input = OIIO::ImageInput::open((folder / "mattes.exr").string());
    REQUIRE(input);
    Read read{input->spec(), {}};
    read.values.resize(read.spec.image_pixels() * static_cast<std::size_t>(read.spec.nchannels));
    REQUIRE(input->read_image(0, 0, 0, read.spec.nchannels, OIIO::TypeDesc::FLOAT, read.values.data()));
    return read;
}

// Of the ids in a pixel's pairs, how much each covers.
std::map<float, float> pairs_of(const Read& read, std::size_t pixel) {
    std::map<float, float> pairs;
    for (const char* layer : {"crypto_ground00", "crypto_ground01"}) {
        for (const auto& [id, share] : {std::pair(".r", ".g"), std::pair(".b", ".a")}) {
            const float covered = read.at(pixel, std::string(layer) + share);
            if (covered > 0.0f) pairs[read.at(pixel, std::string(layer) + id)] = covered;
        }
    }
    return pairs;
}

}  // namespace

TEST_CASE("a file's header tells layers from ids, by the hash of their names") {
    const Read read = write_and_read(mountains(scene::EstimatorKind::none), "cryptomatte");
    const std::string key = "cryptomatte/0ecfd79/";
    CHECK(read.spec.get_string_attribute(key + "name") == "crypto_ground");
    CHECK(read.spec.get_string_attribute(key + "hash") == "MurmurHash3_32");
    CHECK(read.spec.get_string_attribute(key + "conversion") == "uint32_to_float32");
    // By an implementation of the hash in another language.
    CHECK(read.spec.get_string_attribute(key + "manifest") ==
          R"({"rock":"727caf8e","grass":"31186b29","snow":"6c556780"})");
}

TEST_CASE("pairs cover what masks do, together all of a pixel that is ground, and the greatest comes first") {
    for (const scene::EstimatorKind kind : kKinds) {
        CAPTURE(static_cast<int>(kind));
        const Read read = write_and_read(mountains(kind), "mask,cryptomatte,albedo");
        int ground = 0, mixed = 0;
        for (std::size_t i = 0; i < read.pixels(); ++i) {
            const std::map<float, float> pairs = pairs_of(read, i);
            float sum = 0.0f;
            for (const std::string& name : kNames) {
                const auto pair = pairs.find(integrate::crypto_id(name));
                CHECK((pair == pairs.end() ? 0.0f : pair->second) == read.at(i, "mask." + name));
                sum += read.at(i, "mask." + name);
            }
            mixed += pairs.size() > 1;
            // Rounded thrice as shares and once as a mean.
            if (sum > 1.0f - 0x1p-22f) ++ground;
            CHECK(sum <= 1.0f + 0x1p-22f);
            CHECK(read.at(i, "crypto_ground00.g") >= read.at(i, "crypto_ground00.a"));
            CHECK(read.at(i, "crypto_ground00.a") >= read.at(i, "crypto_ground01.g"));
            CHECK(read.at(i, "crypto_ground01.b") == 0.0f);
            CHECK(read.at(i, "crypto_ground01.a") == 0.0f);
        }
        CHECK(ground > 500);
        CHECK(mixed > 300);
    }
}

TEST_CASE("a matte is the albedo of a picture in which its layer alone is white") {
    for (const scene::EstimatorKind kind : {scene::EstimatorKind::stratified, scene::EstimatorKind::shared}) {
        const scene::Scene scene = mountains(kind);
        const Read read = write_and_read(scene, "cryptomatte");
        for (std::size_t layer = 0; layer < kNames.size(); ++layer) {
            scene::Scene white = scene;
            for (std::size_t l = 0; l < white.ground.size(); ++l) white.ground[l].colour = glm::dvec3(l == layer);
            const Read expected = write_and_read(white, "albedo");
            const float id = integrate::crypto_id(kNames[layer]);
            float worst = 0.0f;
            double all = 0.0;
            for (std::size_t i = 0; i < read.pixels(); ++i) {
                const std::map<float, float> pairs = pairs_of(read, i);
                const float matte = pairs.contains(id) ? pairs.at(id) : 0.0f;
                worst = std::max(worst, std::abs(matte - expected.at(i, "albedo.R")));
                all += static_cast<double>(matte);
            }
            CHECK(worst == 0.0f);
            CHECK(all > 20.0);
        }
    }
}

TEST_CASE("who does not ask for mattes pays nothing, who does gets the same picture, and tiles change no bit") {
    for (const scene::EstimatorKind kind : {scene::EstimatorKind::stratified, scene::EstimatorKind::shared_sobol}) {
        const scene::Scene scene = mountains(kind);
        const auto plain = render_with(scene, {}), asked = render_with(scene, channels_of(scene, "mask,cryptomatte"));
        CHECK(plain.film.pixels() == asked.film.pixels());
        CHECK(integrate::same_counts(plain.counters, asked.counters));
        CHECK(plain.film.bytes() < asked.film.bytes());
        const auto tiled = render_with(scene, channels_of(scene, "mask,cryptomatte"), 7);
        CHECK(tiled.film.channels() == asked.film.channels());
    }
}
