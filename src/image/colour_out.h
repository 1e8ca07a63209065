// From light to what a screen is sent: exposure, white balance, saturation and tone curve, then sRGB's transfer
// function. The one way into pictures of 8 and 16 bits and onto canvases; EXR and floating-point TIFF keep the light.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "src/image/agx.h"
#include "src/scene/scene.h"

namespace strata::image {

struct ColourOut {
    double exposure = 0.0;  // stops
    scene::ToneCurve tone = scene::ToneCurve::none;
    glm::dvec3 white_balance{1.0};  // factors of linear light
    double saturation = 1.0;        // 0: greys
    double contrast = 1.0;          // of agx alone
};

// As the scene's keys have it.
ColourOut colour_out(const scene::Film& film);

// What is wrong with it, if anything: "an exposure of inf stops". Exposures are finite, the rest as scene::describe()
// allows.
std::optional<std::string> problem_of(const ColourOut& colour);

// What keeps linear light from being found again in its codes, or nothing: the tone curve "agx". Exposure and white
// balance are factors that can be taken back; a curve's shoulder makes many stops one code, and a saturation of 0 all
// hues one grey.
std::optional<std::string> obstacle_to_light(const ColourOut& colour);

// The light of each channel that the settings made 1.
glm::dvec3 light_of_white(const ColourOut& colour);

// The curves leave mid grey, 0.18, where it is and black black, take whatever is bright enough to white, rise with
// exposure where the light is grey, and never change which channel of a pixel is the largest or the smallest: a hue
// stays in its sixth of the circle. All is evaluated in double, in one order.
class ColourEncoder {
  public:
    explicit ColourEncoder(const ColourOut& colour);

    // The sRGB values in [0,1] of finite light. Grey light has three equal ones.
    glm::dvec3 operator()(const float* rgb) const;

  private:
    glm::dvec3 displayed(glm::dvec3 light) const;

    glm::dvec3 factor_;
    scene::ToneCurve tone_;
    double saturation_;
    Agx agx_;
};

}  // namespace strata::image
