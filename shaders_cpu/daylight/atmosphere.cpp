#include "shaders_cpu/daylight/atmosphere.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace strata::shaders {
namespace {

// Air at sea level, 15 degrees C and 1013.25 hPa: molecules a cubic metre.
constexpr double kMolecules = 2.5469e25;
// Density of the U.S. Standard Atmosphere 1976: up to 11 km temperature falls evenly, above it hardly changes. The
// second scale height is that of 11 to 20 km and serves up to the top: 6 % too thin at 40 km, 25 % at 50. One
// exponential from the ground up would be 2.7 times too dense at 40 km, where the light of twilight comes from.
constexpr double kLapse = 2.25577e-5;  // 6.5 K/km / 288.15 K
constexpr double kLapsePower = 4.25588;
constexpr double kTropopause = 11e3;
constexpr double kTropopauseDensity = 0.297076;
constexpr double kStratosphereHeight = 6341.6;
// Ozone lies between 10 and 40 km, most of it at 25.
constexpr double kOzoneMiddle = 25e3;
constexpr double kOzoneReach = 15e3;
constexpr double kDobsonMolecules = 2.6868e20;  // a square metre
constexpr double kContrast = 3.912;             // -ln 0.02, Koschmieder
// Chosen by paths followed at random with haze's true lobe, sun from 90 to -3 degrees and visibility 60 km: with 0.25,
// 0.5 and 1 the mean sky is within 4, 3 and 7 % of theirs, and the red horizon, where level rays cross much haze,
// within a fifth, a quarter and the double of it.
constexpr double kStraight = 0.5;
constexpr double kVisible_nm = 550.0;

double air_density(double height) {
    if (height < kTropopause) return std::pow(1.0 - kLapse * height, kLapsePower);
    return kTropopauseDensity * std::exp((kTropopause - height) / kStratosphereHeight);
}

double air_scattering(double air, double wavelength_nm) {
    return air * kMolecules * rayleigh_cross_section(wavelength_nm);
}

void require(bool good, const char* name, double value, const char* allowed) {
    if (!good) throw std::invalid_argument(fmt::format("atmosphere: {} = {}; allowed: {}", name, value, allowed));
}

}  // namespace

double clearest_visibility(double air) { return kContrast / air_scattering(air, kVisible_nm); }

void validate(const Atmosphere& a) {
    // Negated comparisons would let NaN pass.
    require(a.visibility >= 1e3 && a.visibility <= 1e9, "visibility", a.visibility, "[1000, 1e9] metres");
    require(a.haze_height >= 100 && a.haze_height <= 10e3, "haze_height", a.haze_height, "[100, 10000] metres");
    require(a.haze_forward >= 0 && a.haze_forward <= 0.95, "haze_forward", a.haze_forward, "[0, 0.95]");
    require(a.haze_albedo >= 0 && a.haze_albedo <= 1, "haze_albedo", a.haze_albedo, "[0, 1]");
    require(a.haze_exponent >= -1 && a.haze_exponent <= 4, "haze_exponent", a.haze_exponent, "[-1, 4]");
    require(a.ozone_dobson >= 0 && a.ozone_dobson <= 2000, "ozone_dobson", a.ozone_dobson, "[0, 2000]");
    require(a.air >= 0 && a.air <= 10, "air", a.air, "[0, 10]");
    require(a.ground_albedo >= 0 && a.ground_albedo <= 1, "ground_albedo", a.ground_albedo, "[0, 1]");
}

AirModel::AirModel(const Atmosphere& a)
    : haze_height_(a.haze_height),
      forward_(a.haze_forward),
      straight_(kStraight * a.haze_forward),
      ground_albedo_(a.ground_albedo) {
    validate(a);
    const double haze_550 = std::max(0.0, kContrast / a.visibility - air_scattering(a.air, kVisible_nm));
    const auto haze = [&](double wavelength_nm) {
        return haze_550 * std::pow(kVisible_nm / wavelength_nm, a.haze_exponent);
    };
    // The profile of ozone has a triangle's area: reach times its middle.
    const double ozone = a.ozone_dobson * kDobsonMolecules / kOzoneReach;
    for (int b = 0; b < 4; ++b) {
        full_.air[b] = air_scattering(a.air, kBand_nm[b]);
        full_.haze[b] = haze(kBand_nm[b]);
        full_.ozone[b] = ozone * kOzoneCrossSection[b];
    }
    for (int c = 0; c < 3; ++c) {
        channels_.air[c] = air_scattering(a.air, kChannel_nm[c]);
        channels_.haze[c] = haze(kChannel_nm[c]);
        channels_.ozone[c] = ozone * kOzoneChannelCrossSection[c];
    }
    haze_scattering_ = full_.haze * a.haze_albedo;
    even_haze_scattering_ = haze_scattering_ * (1.0 - straight_);
    diffuse_ = full_;
    diffuse_.haze = full_.haze - haze_scattering_ * straight_;
}

Densities AirModel::densities(double height) const {
    const double h = std::max(height, 0.0);
    return {air_density(h), std::exp(-h / haze_height_),
            std::max(0.0, 1.0 - std::fabs(h - kOzoneMiddle) / kOzoneReach)};
}

// Of unpolarised light, with the depolarisation of air (0.0279; Chandrasekhar's gamma 0.0141) left out: 1.4 % at most.
double AirModel::rayleigh_phase(double cosine) { return 3.0 / (16.0 * std::numbers::pi) * (1.0 + cosine * cosine); }

// Henyey and Greenstein (1941).
double AirModel::haze_phase(double cosine) const {
    const double base = 1.0 + forward_ * forward_ - 2.0 * forward_ * cosine;
    return (1.0 - forward_ * forward_) / (4.0 * std::numbers::pi * base * std::sqrt(base));
}

double AirModel::haze_lobe(double cosine) const {
    return haze_phase(cosine) - (1.0 - straight_) / (4.0 * std::numbers::pi);
}

}  // namespace strata::shaders
