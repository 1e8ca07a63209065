#include "shaders_cpu/daylight/spectrum.h"

namespace strata::shaders {

// Each band's share in the three channels, in lux. Least squares of relative error in X, Y and Z over the 480 spectra
// of the header: 683 lm/W times the CIE 1931 observer times the sun outside the atmosphere (ASTM G173), on the
// condition that the unchanged sun comes out exactly: 132 540 lux; then the matrix of IEC 61966-2-1.
glm::dvec3 to_rgb(const Bands& light) {
    return glm::dvec3(121857.7, -5330.8, -2292.3) * light[0] + glm::dvec3(74412.2, 97521.6, -16678.7) * light[1] +
           glm::dvec3(-73929.2, 54254.3, 62426.9) * light[2] + glm::dvec3(22400.4, -16974.5, 83581.0) * light[3];
}

double luminance(const glm::dvec3& rgb) { return 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b; }

double rayleigh_cross_section(double wavelength_nm) {
    const double square = 1e-6 * wavelength_nm * wavelength_nm;  // in square micrometres
    const double inverse = 1.0 / square;
    return 1e-32 * (1.0455996 - 341.29061 * inverse - 0.90230850 * square) /
           (1.0 + 0.0027059889 * inverse - 85.968563 * square);
}

}  // namespace strata::shaders
