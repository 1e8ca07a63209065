// In place of the samples that channels are computed from: the fuzzers ask which channels a scene has and how a file
// names them, and do without the engine that renders them. No sample is ever looked at here.
#include <cstdlib>

#include "src/integrate/sample_view.h"

namespace strata::integrate {

bool SampleView::is_water() const { std::abort(); }
double SampleView::distance() const { std::abort(); }
double SampleView::depth() const { std::abort(); }
glm::dvec3 SampleView::position() const { std::abort(); }
glm::dvec3 SampleView::normal() const { std::abort(); }
glm::vec3 SampleView::reflectance() const { std::abort(); }
double SampleView::height_mask() const { std::abort(); }
double SampleView::slope_mask() const { std::abort(); }
void SampleView::ground_shares(std::span<float>) const { std::abort(); }
glm::vec3 SampleView::reflected(shaders::LightLayer) const { std::abort(); }
glm::vec3 SampleView::inscatter() const { std::abort(); }
glm::vec3 SampleView::water() const { std::abort(); }
glm::vec3 SampleView::background() const { std::abort(); }
double SampleView::cloud_opacity() const { std::abort(); }
double SampleView::sun_visibility() const { std::abort(); }
glm::dvec2 SampleView::motion() const { std::abort(); }
std::uint64_t SampleView::steps() const { std::abort(); }
std::uint64_t SampleView::noise_evaluations() const { std::abort(); }

}  // namespace strata::integrate
