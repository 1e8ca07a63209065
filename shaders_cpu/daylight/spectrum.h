// Four wavelengths in the place of a spectrum, and what they come to for the eye.
//
// Three bands turn a low sun's sky green: extinction by air grows as wavelength^-4, and a mean over a third of the
// spectrum does not decay as any one wavelength in it does. Four, at 630, 560, 490 and 430 nm, do not: over 480 spectra
// - air masses 0 to 35, aerosol depths 0 to 1, up to 25 times the usual ozone, direct or scattered light - the colour
// that to_rgb() gives is within 0.0072 in (u',v') of the one that integrals every 10 nm give, and the luminance
// within 1.4 %.
#pragma once

#include <glm/glm.hpp>

namespace strata::shaders {

// A value at each of kBand_nm. Light is given relative to the sunlight outside the atmosphere in the same band: 1 is
// the irradiance of a plane that faces the sun there, so radiance is in 1/sr.
using Bands = glm::dvec4;

inline constexpr double kBand_nm[4] = {630.0, 560.0, 490.0, 430.0};

// The wavelengths at which extinction acts on the three channels of a whitish thing seen through air: of all they come
// closest to the channels' own ratio over 5 to 80 km of air, as clear or five times as hazy. The blue one lies far out
// because linear blue is what is left after green is taken away.
inline constexpr double kChannel_nm[3] = {643.0, 544.0, 442.0};

// Linear Rec.709, of luminance 0.2126 R + 0.7152 G + 0.0722 B: lux for irradiance, cd/m^2 for radiance. May be negative
// for colours that the screen has not: sunlight through 30 air masses, twilight's zenith.
glm::dvec3 to_rgb(const Bands& light);

double luminance(const glm::dvec3& rgb);

// Scattering cross-section of a molecule of air, m^2: fit of Bodhaine, Wood, Dutton and Slusser, "On Rayleigh optical
// depth calculations", J. Atmos. Oceanic Technol. 16 (1999), eq. 29, for 360 ppm of CO2; within 0.01 % over 250-850 nm.
double rayleigh_cross_section(double wavelength_nm);

// Absorption cross-section of a molecule of ozone, m^2, at the wavelengths above, from the measurements of Serdyuchenko
// and Gorshelev (Atmos. Meas. Tech. 7, 2014) as averaged over 10 nm and interpolated.
inline constexpr double kOzoneCrossSection[4] = {3.215e-25, 4.266e-25, 9.016e-26, 8.451e-27};
inline constexpr double kOzoneChannelCrossSection[3] = {2.535e-25, 3.255e-25, 1.729e-26};

}  // namespace strata::shaders
