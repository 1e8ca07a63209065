#include "src/image/light.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "src/image/icc_curve.h"
#include "src/image/image_error.h"
#include "src/image/read.h"
#include "src/image/srgb.h"
#include "src/image/write.h"
#include "tests/image/foreign_picture.h"
#include "tests/image/scratch_folder.h"

using namespace strata::image;

namespace {

using OIIO::TypeDesc;

const std::vector<float> kRgb{0.0f, 0.25f, 1.0f, 0.5f, 0.1f, 0.75f};

std::vector<float> light_of(const std::filesystem::path& path) { return read_linear(path).rgb; }

// To the half code of 16 bits that files of whole numbers round to, or of 8.
bool near(const std::vector<float>& found, const std::vector<double>& expected, double codes) {
    if (found.size() != expected.size()) return false;
    for (std::size_t i = 0; i < found.size(); ++i)
        if (!(std::fabs(found[i] - expected[i]) <= 3.0 / codes)) return false;
    return true;
}

template <class Curve>
std::vector<double> through(const std::vector<float>& values, const Curve& curve) {
    std::vector<double> result;
    for (const float value : values) result.push_back(curve(value));
    return result;
}

const auto kSrgb = [](double v) { return decode_srgb(v); };
const auto kNothing = [](double v) { return v; };

std::string error_of(const std::filesystem::path& path) {
    try {
        read_linear(path);
    } catch (const ImageError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a TIFF in floating point is linear, to the bit, beyond 1 and below 0; one of whole numbers is sRGB") {
    const ScratchFolder folder;
    const std::vector<float> wide{-3.5f, 1e30f, 0.18f, 1e-30f, 7.0f, 0.5f};
    write_foreign(folder / "f.tif", {.values = wide});
    CHECK(light_of(folder / "f.tif") == wide);
    CHECK(read_linear(folder / "f.tif", {.exposure = 1.5}).rgb == wide);
    write_foreign(folder / "d.tif", {.type = TypeDesc::DOUBLE, .values = wide});  // would be read as zeros
    CHECK(error_of(folder / "d.tif").find("64 bits") != std::string::npos);
    write_foreign(folder / "u.tif", {.type = TypeDesc::UINT16, .values = kRgb});
    CHECK(near(light_of(folder / "u.tif"), through(kRgb, kSrgb), 65535));
    write_foreign(folder / "b.tif", {.type = TypeDesc::UINT8, .values = kRgb});
    CHECK(near(light_of(folder / "b.tif"), through(kRgb, kSrgb), 255));
}

TEST_CASE("a PNG is what its gAMA says, sRGB if it says nothing") {
    const ScratchFolder folder;
    const auto written = [&](const char* space) {
        write_foreign(folder / "a.png", {.type = TypeDesc::UINT16, .values = kRgb, .colour_space = space});
        return light_of(folder / "a.png");
    };
    CHECK(near(written("Linear"), through(kRgb, kNothing), 65535));
    CHECK(near(written("GammaCorrected1.8"), through(kRgb, [](double v) { return std::pow(v, 1.8); }), 65535));
    CHECK(near(written("GammaCorrected2.2"), through(kRgb, kSrgb), 65535));
    CHECK(near(written("sRGB"), through(kRgb, kSrgb), 65535));
    CHECK(near(written(""), through(kRgb, kSrgb), 65535));
}

TEST_CASE("the cICP of a PNG goes before all else that it says of its colours") {
    const ScratchFolder folder;
    const auto written = [&](const char* space, const std::string& cicp) {
        write_foreign(folder / "a.png", {.type = TypeDesc::UINT16, .values = kRgb, .colour_space = space});
        insert_png_chunk(folder / "a.png", "cICP", cicp);
    };
    written("sRGB", std::string("\1\x8\0\1", 4));
    CHECK(near(light_of(folder / "a.png"), through(kRgb, kNothing), 65535));
    written("Linear", std::string("\1\xd\0\1", 4));
    CHECK(near(light_of(folder / "a.png"), through(kRgb, kSrgb), 65535));
    written("sRGB", std::string("\1\5\0\1", 4));
    CHECK(near(light_of(folder / "a.png"), through(kRgb, [](double v) { return std::pow(v, 2.8); }), 65535));
    for (const char transfer : {'\x10', '\x12'}) {
        std::string cicp("\x9\0\0\1", 4);
        cicp[1] = transfer;
        written("sRGB", cicp);
        const std::string message = error_of(folder / "a.png");
        CHECK(message.find("a.png") != std::string::npos);
        CHECK(message.find("PQ or HLG") != std::string::npos);
    }
    written("Linear", "cut");  // no four numbers: as if it were not there
    CHECK(near(light_of(folder / "a.png"), through(kRgb, kNothing), 65535));
}

TEST_CASE("an ICC profile's curve is followed where it is linear or a power") {
    const ScratchFolder folder;
    const std::string linear("curv\0\0\0\0\0\0\0\0", 12);
    const std::string parametric = std::string("para\0\0\0\0\0\0\0\0", 12) + std::string("\0\1\x80\0", 4);  // 1.5
    const std::string srgb = std::string("para\0\0\0\0\0\3\0\0", 12) + std::string(20, '\1');
    const std::string table = std::string("curv\0\0\0\0\0\0\0\3", 12) + std::string("\0\0\x20\0\xff\xff", 6);
    const auto written = [&](const char* name, const char* tag, const std::string& curve) {
        write_foreign(folder / name,
                      {.type = TypeDesc::UINT16, .values = kRgb, .icc_profile = icc_profile(tag, curve)});
        return light_of(folder / name);
    };
    CHECK(near(written("a.tif", "rTRC", linear), through(kRgb, kNothing), 65535));
    CHECK(near(written("a.tif", "kTRC", power_curve_of_icc(1.0)), through(kRgb, kNothing), 65535));
    const auto power = [](double v) { return std::pow(v, 1.5); };
    CHECK(near(written("a.tif", "rTRC", parametric), through(kRgb, power), 65535));
    CHECK(near(written("a.tif", "rTRC", power_curve_of_icc(1.5)), through(kRgb, power), 65535));
    CHECK(near(written("a.tif", "rTRC", srgb), through(kRgb, kSrgb), 65535));
    CHECK(near(written("a.tif", "rTRC", table), through(kRgb, kSrgb), 65535));
    CHECK(near(written("a.tif", "gTRC", linear), through(kRgb, kSrgb), 65535));
    std::vector<unsigned char> cut = icc_profile("rTRC", linear);
    for (std::size_t size = 0; size < cut.size(); size += 7) {
        CAPTURE(size);
        CHECK(power_of_icc({cut.data(), size}) == (size > 144 + 11 ? std::optional(1.0) : std::nullopt));
    }
}

TEST_CASE("grey is grey in all three channels, in every format and depth") {
    const ScratchFolder folder;
    const std::vector<float> grey{0.0f, 0.25f, 1.0f, 0.6f};
    const auto spread = [&](const auto& curve) {
        std::vector<double> result;
        for (const float v : grey) result.insert(result.end(), 3, curve(v));
        return result;
    };
    for (const auto& [name, type, codes] : {std::tuple{"a.png", TypeDesc::UINT8, 255.0},
                                            {"b.png", TypeDesc::UINT16, 65535.0},
                                            {"a.tif", TypeDesc::UINT8, 255.0},
                                            {"b.tif", TypeDesc::UINT16, 65535.0},
                                            {"a.jpg", TypeDesc::UINT8, 40.0}}) {
        CAPTURE(name);
        write_foreign(folder / name, {.channels = "Y", .type = type, .values = grey});
        CHECK(near(light_of(folder / name), spread(kSrgb), codes));
        CHECK(near(read_picture(folder / name).rgb, spread(kNothing), codes));
    }
    for (const char* name : {"f.tif", "f.exr"}) {
        CAPTURE(name);
        write_foreign(folder / name, {.channels = "Y", .values = grey});
        CHECK(near(light_of(folder / name), spread(kNothing), 1e8));
    }
}

TEST_CASE("alpha is light over black, whether the colour was multiplied by it or not") {
    const ScratchFolder folder;
    const std::vector<float> ya{0.8f, 0.5f, 0.3f, 1.0f, 0.9f, 0.0f};
    const auto over_black = [&](const auto& curve) {
        std::vector<double> result;
        for (std::size_t i = 0; i < ya.size(); i += 2) result.insert(result.end(), 3, curve(ya[i]) * ya[i + 1]);
        return result;
    };
    // OpenImageIO takes unassociated values as they are.
    for (const char* name : {"ya.png", "ya.tif"}) {
        CAPTURE(name);
        write_foreign(folder / name,
                      {.channels = "YA", .type = TypeDesc::UINT16, .values = ya, .is_unassociated = true});
        CHECK(near(light_of(folder / name), over_black(kSrgb), 65535));
    }
    write_foreign(folder / "f.tif", {.channels = "YA", .values = ya, .is_unassociated = true});
    CHECK(near(light_of(folder / "f.tif"), over_black(kNothing), 1e6));

    const std::vector<float> rgba{0.8f, 0.4f, 0.2f, 0.5f, 0.3f, 0.2f, 0.1f, 1.0f};
    write_foreign(folder / "c.png",
                  {.channels = "RGBA", .type = TypeDesc::UINT16, .values = rgba, .is_unassociated = true});
    const std::vector<double> expected{kSrgb(0.8) / 2, kSrgb(0.4) / 2, kSrgb(0.2) / 2,
                                       kSrgb(0.3),     kSrgb(0.2),     kSrgb(0.1)};
    CHECK(near(light_of(folder / "c.png"), expected, 65535));
    // Codes that were multiplied by alpha: 0.8 * 0.5 and so on.
    const std::vector<float> associated{0.4f, 0.2f, 0.1f, 0.5f, 0.3f, 0.2f, 0.1f, 1.0f};
    write_foreign(folder / "c.tif", {.channels = "RGBA", .type = TypeDesc::UINT16, .values = associated});
    CHECK(near(light_of(folder / "c.tif"), expected, 65535));
    // Light that was.
    write_foreign(folder / "c.exr", {.channels = "RGBA", .values = associated});
    CHECK(near(light_of(folder / "c.exr"), {0.4, 0.2, 0.1, 0.3, 0.2, 0.1}, 1e8));
}

TEST_CASE("channels are found by name, and those without a known meaning are refused by name") {
    const ScratchFolder folder;
    write_foreign(folder / "z.exr", {.channels = "BGRZ", .values = {0.1f, 0.2f, 0.3f, 9.0f}});
    CHECK(light_of(folder / "z.exr") == std::vector<float>{0.3f, 0.2f, 0.1f});
    write_foreign(folder / "uv.exr", {.channels = "UV", .values = {0.1f, 0.2f}});
    const std::string message = error_of(folder / "uv.exr");
    CHECK(message.find("uv.exr") != std::string::npos);
    CHECK(message.find("its channels are U, V") != std::string::npos);
}

TEST_CASE("what is not finite in a picture of another program is read as it is") {
    const ScratchFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (const char* name : {"n.tif", "n.exr"}) {
        write_foreign(folder / name, {.values = {nan, infinity, -infinity, 0.5f, 0.25f, 1.0f}});
        const std::vector<float> read = light_of(folder / name);
        CHECK(std::isnan(read[0]));
        CHECK(read[1] == infinity);
        CHECK(read[2] == -infinity);
        CHECK(read[3] == 0.5f);
    }
}
