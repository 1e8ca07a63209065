// AgX, the view that T. Sobotka designed (github.com/sobotka/AgX): light is mixed with a little white, encoded by its
// logarithm, bent by a sigmoid and unmixed again. What is bright loses its colour little by little, as on film, instead
// of being clipped to a pure one. Private to src/image.
#pragma once

#include <glm/glm.hpp>

namespace strata::image {

// Light from -10 to +6.5 stops about mid grey has a code of its own; darker is black, brighter white.
inline constexpr double kAgxDarkest = -10.0, kAgxBrightest = 6.5;

// The inset: light as amounts of primaries that lie 1 / (1 - kAgxInset) times as far from the white point as Rec.
// 709's. All three amounts get the same share of the light's channels, and the rest stays: (1 - kAgxInset) c + w.c,
// where the sum of w is kAgxInset. The test derives w from the chromaticities; the matrix published with AgX is this
// one to 1e-4.
inline constexpr double kAgxInset = 0.2;
inline constexpr glm::dvec3 kAgxShare{0.04239892904953146, 0.07843016510486392, 0.07917090584560462};

class Agx {
  public:
    // The sigmoid's slope at mid grey is 2 times contrast, [0.7, 2].
    explicit Agx(double contrast = 1.0);

    // Display light in [0,1] of light that is not negative, beside which values beyond [0,1] may stand for colours that
    // the display does not have. Saturation is applied behind the sigmoid, as AgX's looks do.
    glm::dvec3 displayed(const glm::dvec3& light, double saturation) const;

    // From [0,1], which the stops are spread over, to [0,1]: rises, 0 at 0 and 1 at 1.
    double sigmoid(double x) const;

  private:
    double slope_, toe_, shoulder_;
};

}  // namespace strata::image
