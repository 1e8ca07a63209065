// The air of the Earth: a shell of three things that scatter or absorb, each with a profile of density over height.
#pragma once

#include <glm/glm.hpp>

#include "shaders_cpu/daylight/spectrum.h"

namespace strata::shaders {

// What may be chosen. Lengths in metres.
struct Atmosphere {
    double visibility =
        100e3;  // distance at sea level over which 2 % of the contrast is left: 3.912 / extinction at 550 nm
    double haze_height = 1200;  // over which haze thins by e
    double haze_forward = 0.8;  // mean cosine of the angle by which haze scatters
    double haze_albedo = 0.94;  // what haze scatters of the light it takes out
    double haze_exponent =
        1.2;  // of haze's extinction, wavelength^-exponent: 0 for droplets, 1 to 1.5 for dry dust and smoke
    double ozone_dobson = 300;   // column of ozone, 1/100 mm of it at normal pressure
    double air = 1;              // density of air in units of Earth's
    double ground_albedo = 0.2;  // of the sphere below, grey

    bool operator==(const Atmosphere&) const = default;
};

// Throws std::invalid_argument that names the value and what is allowed.
void validate(const Atmosphere& atmosphere);

inline constexpr double kEarthRadius = 6371e3;
inline constexpr double kAirTop = 100e3;  // there is none above: a millionth of all of it would be
inline constexpr double kSunRadius = 0.2666 / 180.0 * 3.14159265358979323846;  // angle, of the disc
inline constexpr double kSunSolidAngle = 6.80e-5;                              // sr

// The most that can be seen at sea level without any haze, metres: air alone scatters.
double clearest_visibility(double air);

// The three densities, each relative to the one that its coefficients are for.
struct Densities {
    double air, haze, ozone;
};

// Coefficients per metre at density 1 and the profiles. `Spectrum` is Bands, or dvec3 for the channels.
template <class Spectrum>
struct Coefficients {
    Spectrum air, haze, ozone;  // extinction

    // Optical depth of columns in metres of density 1.
    Spectrum depth(const Densities& columns) const {
        return air * columns.air + haze * columns.haze + ozone * columns.ozone;
    }
};

// Light that haze turns a little is hard to tell from light that never met any. So diffuse light, which has been
// scattered before, sees a haze that lets a part of what it scatters - half of haze_forward - go straight on, and sends
// the rest everywhere evenly: less extinction, no lobe. The haze that the sun is seen through, and its light scattered
// once into the eye, keep the true lobe, so that the bright ring about the sun is right (Nakajima and Tanaka 1988,
// their "TMS").
class AirModel {
  public:
    explicit AirModel(const Atmosphere& atmosphere);

    Densities densities(double height) const;

    const Coefficients<Bands>& full() const { return full_; }        // for light straight from the sun, once scattered
    const Coefficients<Bands>& diffuse() const { return diffuse_; }  // for the rest
    const Coefficients<glm::dvec3>& channels() const { return channels_; }  // for what is seen through the air
    const Bands& haze_scattering() const { return haze_scattering_; }
    const Bands& even_haze_scattering() const { return even_haze_scattering_; }  // the part that goes everywhere

    // Share of the scattered light per steradian, by the cosine of the angle that it turns by.
    static double rayleigh_phase(double cosine);
    double haze_phase(double cosine) const;

    // haze_phase() less the part that even_haze_scattering() has in it already.
    double haze_lobe(double cosine) const;

    double ground_albedo() const { return ground_albedo_; }

  private:
    Coefficients<Bands> full_, diffuse_;
    Coefficients<glm::dvec3> channels_;
    Bands haze_scattering_, even_haze_scattering_;
    double haze_height_, forward_, straight_, ground_albedo_;
};

}  // namespace strata::shaders
