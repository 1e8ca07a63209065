#include "src/integrate/pattern_image.h"

#include <cassert>
#include <stdexcept>

#include "shaders_cpu/checker.h"
#include "shaders_cpu/constant.h"
#include "shaders_cpu/edge.h"
#include "shaders_cpu/ramp.h"
#include "shaders_cpu/wheel.h"
#include "shaders_cpu/zoneplate.h"
#include "src/integrate/fill_channels.h"

namespace strata::integrate {
namespace {

// `Pattern` is a function of (parameters, width, height, u, v, t), known at compile time: one virtual call a batch.
template <class Parameters, float (*Pattern)(const Parameters&, int, int, double, double, double)>
class PatternImage final : public ImageFunction {
  public:
    PatternImage(const Parameters& parameters, const scene::Film& film)
        : parameters_(parameters), width_(film.width), height_(film.height) {}

    void evaluate(const SampleBatch& samples, const SampleOut& out, Counters& /*counters*/) const override {
        assert(samples.v.size() == samples.u.size() && samples.t.size() == samples.u.size());
        assert(out.radiance.size() == samples.u.size());
        for (std::size_t i = 0; i < out.radiance.size(); ++i) {
            const float value = Pattern(parameters_, width_, height_, samples.u[i], samples.v[i], samples.t[i]);
            out.radiance[i] = glm::vec3(value);
        }
        fill_channels(out);
    }

  private:
    Parameters parameters_;
    int width_;
    int height_;
};

}  // namespace

std::unique_ptr<ImageFunction> make_pattern_image(const scene::Scene& scene) {
    switch (scene.image) {
        case scene::ImageKind::zoneplate:
            return std::make_unique<PatternImage<scene::Zoneplate, shaders::zoneplate>>(scene.zoneplate, scene.film);
        case scene::ImageKind::checker:
            return std::make_unique<PatternImage<scene::Checker, shaders::checker>>(scene.checker, scene.film);
        case scene::ImageKind::wheel:
            return std::make_unique<PatternImage<scene::Wheel, shaders::wheel>>(scene.wheel, scene.film);
        case scene::ImageKind::edge:
            return std::make_unique<PatternImage<scene::Edge, shaders::edge>>(scene.edge, scene.film);
        case scene::ImageKind::ramp:
            return std::make_unique<PatternImage<scene::Ramp, shaders::ramp>>(scene.ramp, scene.film);
        case scene::ImageKind::constant:
            return std::make_unique<PatternImage<scene::Constant, shaders::constant>>(scene.constant, scene.film);
        case scene::ImageKind::surface:
            break;
    }
    throw std::invalid_argument("a surface is no image-plane pattern");
}

}  // namespace strata::integrate
