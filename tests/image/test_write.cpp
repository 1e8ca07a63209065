#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "src/image/image_error.h"
#include "src/image/read.h"
#include "src/image/write.h"
#include "tests/image/scratch_folder.h"

using namespace strata::image;

namespace {

constexpr const char* kExtensions[] = {".exr", ".png", ".tif", ".jpg"};

Picture random_picture(int width, int height, float top) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> value(0.0f, top);
    Picture picture = make_picture(width, height);
    for (float& v : picture.rgb) v = value(random);
    return picture;
}

Picture crop_of(const Picture& whole, int x0, int y0, int x1, int y1) {
    Picture crop{whole.frame_width, whole.frame_height, x0, y0, x1, y1, {}};
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            for (int c = 0; c < 3; ++c) crop.rgb.push_back(whole.rgb[3 * (y * whole.frame_width + x) + c]);
    return crop;
}

void check_same_window(const Picture& a, const Picture& b) {
    CHECK(a.frame_width == b.frame_width);
    CHECK(a.frame_height == b.frame_height);
    CHECK(a.x0 == b.x0);
    CHECK(a.y0 == b.y0);
    CHECK(a.x1 == b.x1);
    CHECK(a.y1 == b.y1);
}

double largest_difference(const Picture& a, const Picture& b) {
    REQUIRE(a.rgb.size() == b.rgb.size());
    double largest = 0.0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i)
        largest = std::max(largest, std::fabs(static_cast<double>(a.rgb[i]) - b.rgb[i]));
    return largest;
}

// What the standard prints, solved for the code by bisection on its decoding side: no power of 1/2.4 in here.
int nearest_code(double linear, int top) {
    const auto decode = [](double v) {
        return v <= 12.92 * 0.0031308 ? v / 12.92 : std::exp(2.4 * std::log((v + 0.055) / 1.055));
    };
    int low = 0;
    int high = top;
    while (low < high) {
        const int middle = (low + high) / 2;
        // Codes above `middle` begin where the encoded value passes middle + 1/2.
        if (linear < decode((middle + 0.5) / top))
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

std::string error_of(const std::filesystem::path& path, const Picture& picture, const Metadata& metadata = {},
                     const WriteOptions& options = {}) {
    try {
        write_picture(path, picture, metadata, options);
    } catch (const ImageError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a float EXR gives back every bit, a half EXR every half") {
    const ScratchFolder folder;
    Picture picture = random_picture(37, 23, 5.0f);
    picture.rgb[0] = -3.5f;
    picture.rgb[1] = 1e30f;
    picture.rgb[2] = 1e-30f;
    write_picture(folder / "f.exr", picture, {}, {{}, ExrFormat::floating});
    CHECK(read_picture(folder / "f.exr").rgb == picture.rgb);

    write_picture(folder / "h.exr", picture);
    const Picture half = read_picture(folder / "h.exr");
    CHECK(half.rgb[1] == 65504.0f);
    double worst = 0.0;
    for (std::size_t i = 3; i < picture.rgb.size(); ++i) {
        // Half the distance of neighbouring halves: 11 bits of significand, 2^-24 the smallest half.
        const double bound = std::max(std::fabs(picture.rgb[i]) * std::ldexp(1.0, -11), std::ldexp(1.0, -25));
        worst = std::max(worst, std::fabs(static_cast<double>(half.rgb[i]) - picture.rgb[i]) / bound);
    }
    CHECK(worst <= 1.0);
    MESSAGE("half rounding, observed / bound: ", worst);
}

TEST_CASE("16-bit pictures hold the nearest sRGB code after exposure, 8-bit ones a code beside the value") {
    const ScratchFolder folder;
    Picture picture = random_picture(64, 64, 1.2f);
    const float special[] = {0.0f, 1.0f, 0.0031308f, 0.18f, -1.0f, 1e30f, 1e-30f, 0.5f};
    std::copy(std::begin(special), std::end(special), picture.rgb.begin());
    for (const double exposure : {0.0, 1.0, -2.5, 0.37}) {
        write_picture(folder / "a.png", picture, {}, {{.exposure = exposure}, ExrFormat::half});
        write_picture(folder / "a.tiff", picture, {}, {{.exposure = exposure}, ExrFormat::half});
        const Picture eight = read_picture(folder / "a.png"), sixteen = read_picture(folder / "a.tiff");
        int wrong = 0, far = 0;
        for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
            const double light = picture.rgb[i] * std::exp2(exposure);
            wrong += std::lround(sixteen.rgb[i] * 65535.0) != nearest_code(light, 65535);
            constexpr int kParts = 257;  // of a code, which tell where between two codes the value lies
            const double value = static_cast<double>(nearest_code(light, 255 * kParts)) / kParts;
            far += std::fabs(eight.rgb[i] * 255.0 - value) >= 1.0 + 0.5 / kParts;
        }
        // Codes whose half-way point is met to the last digit may fall either way.
        CHECK_MESSAGE(wrong <= 2, "at " << exposure << " stops: " << wrong);
        CHECK_MESSAGE(far == 0, "at " << exposure << " stops: " << far);
    }
}

TEST_CASE("mid-grey of 18 % is code 117.65 in the mean of a PNG, 30235 in a TIFF") {
    const ScratchFolder folder;
    Picture picture = make_picture(1024, 1);
    for (float& value : picture.rgb) value = 0.18f;
    write_picture(folder / "grey.png", picture);
    write_picture(folder / "grey.tif", picture);
    double sum = 0;
    for (const float value : read_picture(folder / "grey.png").rgb) sum += value * 255.0;
    CHECK(std::fabs(sum / static_cast<double>(picture.rgb.size()) - 117.6457) < 0.001);
    CHECK(std::lround(read_picture(folder / "grey.tif").rgb[0] * 65535.0f) == 30235);
}

TEST_CASE("a JPEG keeps a smooth picture to within a few codes") {
    const ScratchFolder folder;
    Picture picture = make_picture(64, 48);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) {
            float* rgb = &picture.rgb[3 * (y * 64 + x)];
            rgb[0] = static_cast<float>(x) / 64.0f;
            rgb[1] = static_cast<float>(y) / 48.0f;
            rgb[2] = 0.3f;
        }
    write_picture(folder / "a.jpeg", picture);
    write_picture(folder / "a.png", picture);
    const double difference =
        255.0 * largest_difference(read_picture(folder / "a.jpeg"), read_picture(folder / "a.png"));
    CHECK(difference <= 8.0);
    MESSAGE("largest JPEG difference, codes: ", difference);
}

TEST_CASE("EXR and TIFF keep crop and frame, PNG and JPEG hold the crop alone") {
    const ScratchFolder folder;
    const Picture crop = crop_of(random_picture(100, 50, 1.0f), 13, 7, 64, 50);
    for (const char* extension : {".exr", ".tif"}) {
        const auto path = folder / (std::string("crop") + extension);
        write_picture(path, crop);
        check_same_window(read_picture(path), crop);
    }
    for (const char* extension : {".png", ".jpg"}) {
        const auto path = folder / (std::string("crop") + extension);
        write_picture(path, crop);
        check_same_window(read_picture(path), make_picture(51, 43));
    }
}

TEST_CASE("a crop far from the corner of a tall frame keeps its place") {
    const ScratchFolder folder;
    Picture crop{20000, 19999, 19997, 19991, 20000, 19999, std::vector<float>(3 * 3 * 8, 0.25f)};
    for (const char* extension : {".exr", ".tif"}) {
        const auto path = folder / (std::string("far") + extension);
        write_picture(path, crop);
        check_same_window(read_picture(path), crop);
    }
}

TEST_CASE("pictures of 1x1 and 1x20000 pixels come back") {
    const ScratchFolder folder;
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 20000}, {20000, 1}})
        for (const char* extension : kExtensions) {
            const Picture picture = random_picture(width, height, 1.0f);
            const auto path = folder / (std::string("thin") + extension);
            write_picture(path, picture);
            check_same_window(read_picture(path), picture);
        }
}

TEST_CASE("equal pictures are equal files however far apart they are written") {
    const ScratchFolder folder;
    const Picture picture = random_picture(40, 30, 1.0f);
    Metadata metadata;
    metadata.set(kSceneKey, "title = \"x\"\n");
    for (const char* extension : kExtensions)
        write_picture(folder / (std::string("first") + extension), picture, metadata);
    usleep(1'100'000);  // past the next second: no clock may show
    for (const char* extension : kExtensions) {
        const auto second = folder / (std::string("second") + extension);
        write_picture(second, picture, metadata);
        const std::string bytes = file_bytes(second);
        CHECK(!bytes.empty());
        CHECK_MESSAGE(bytes == file_bytes(folder / (std::string("first") + extension)), extension);
    }
}

TEST_CASE("NaN and infinite pixels are refused, counted and named, and leave the earlier file") {
    const ScratchFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    for (const char* extension : kExtensions) {
        const auto path = folder / (std::string("bad") + extension);
        write_bytes(path, "earlier");
        Picture picture = crop_of(random_picture(20, 10, 1.0f), 5, 2, 15, 9);
        picture.rgb[3 * (4 * 10 + 7) + 1] = nan;
        picture.rgb[3 * (6 * 10 + 1) + 2] = -infinity;
        const std::string message = error_of(path, picture);
        CHECK(message.find("2 pixels are not finite") != std::string::npos);
        CHECK(message.find("(12,6)") != std::string::npos);
        CHECK(message.find(path.string()) != std::string::npos);
        CHECK(file_bytes(path) == "earlier");
    }
    CHECK(folder.names().size() == 4);
}

TEST_CASE("a picture that contradicts itself is refused") {
    const ScratchFolder folder;
    Picture picture = make_picture(4, 3);
    picture.rgb.pop_back();
    CHECK(error_of(folder / "a.exr", picture).find("35 values") != std::string::npos);
    CHECK(error_of(folder / "a.exr", {4, 3, 0, 0, 5, 3, std::vector<float>(45)}).find("0,0,5,3") != std::string::npos);
    CHECK(!error_of(folder / "a.exr", {4, 3, 2, 0, 2, 3, {}}).empty());
    CHECK(!error_of(folder / "a.exr", {4, 3, 3, 0, 1, 3, {}}).empty());
    CHECK(!error_of(folder / "a.png", make_picture(2, 2), {}, {{.exposure = std::nan("")}, ExrFormat::half}).empty());
    CHECK(folder.names().empty());
}

TEST_CASE("a JPEG beyond 65500 pixels a side is refused, other formats take it") {
    const ScratchFolder folder;
    CHECK(error_of(folder / "long.jpg", make_picture(65501, 1)).find("65500") != std::string::npos);
    CHECK(error_of(folder / "long.jpg", make_picture(65500, 1)).empty());
    for (const char* name : {"long.exr", "long.png", "long.tif"}) {
        write_picture(folder / name, make_picture(70000, 1));
        CHECK(read_picture(folder / name).width() == 70000);
    }
}

TEST_CASE("extreme exposures give black or white, never garbage") {
    const ScratchFolder folder;
    Picture picture = make_picture(2, 1);
    picture.rgb = {0.0f, 1e-30f, 1.0f, 0.0f, 1e30f, -1.0f};
    write_picture(folder / "a.png", picture, {}, {{.exposure = 1e9}, ExrFormat::half});
    CHECK(read_picture(folder / "a.png").rgb == std::vector<float>{0, 1, 1, 0, 1, 0});
    write_picture(folder / "a.png", picture, {}, {{.exposure = -1e9}, ExrFormat::half});
    CHECK(read_picture(folder / "a.png").rgb == std::vector<float>{0, 0, 0, 0, 0, 0});
}
