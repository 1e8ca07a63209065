// What the stages of a surface's picture hand on: arrays over some samples of a batch, and over those of them that hit.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "shaders_cpu/shading_point.h"
#include "shaders_cpu/water_waves.h"
#include "src/accel/sun_beams.h"
#include "src/accel/zones.h"
#include "src/sample/dimensions.h"
#include "src/trace/ray.h"
#include "src/trace/window_tracer.h"

namespace strata::integrate {

// Rays from hits towards the lights that cast shadows, light after light.
struct ShadowRays {
    std::vector<trace::Ray> rays;
    std::vector<trace::Hit> hits;
    std::vector<std::uint32_t> owner;  // of the surface hits, by index
    std::vector<double> spacing;       // of one light's, how far those of neighbouring samples are apart, about
    accel::SunlitCells sunlit;

    void clear() {
        rays.clear();
        hits.clear();
        owner.clear();
        spacing.clear();
    }
};

// Rays that windows did not settle, on their way from zone to zone.
struct OpenRays {
    struct Place {
        std::uint32_t ray = 0;  // by index in the chunk
        std::uint32_t cell = 0;
        std::uint32_t zone = 0;
    };
    std::vector<Place> places, next;
    std::vector<trace::Ray> rays;
    std::vector<trace::Hit> hits;
};

// Where a ray ends on level water, and what is seen there.
struct WaterHit {
    std::uint32_t sample;  // of the chunk's, by index
    glm::dvec3 x, normal;  // of the waves that the sample tells
    shaders::WaveSlopes waves;
    glm::dvec3 facet;    // the normal of what it sees of the finer ones
    double reflected;    // share of light, by the facet
    glm::vec3 radiance;  // towards the eye
};

// One each thread; its memory is reused from chunk to chunk, for fresh memory would cost as much as the shading.
struct SurfaceChunk {
    std::span<const std::uint32_t> order;  // which samples of the batch these are

    // place_rays: of each sample, in the surface's coordinates.
    std::vector<trace::Ray> rays;
    std::vector<glm::dvec3> view;  // the rays' directions, as the sky lies; empty where those are the rays' own

    std::vector<double> time;  // of each, seconds; empty where nobody asks

    // The same: towards each light, of unit length. Light l's from to_light[l * directions_a_light] on, of each sample
    // or one of all.
    std::vector<glm::dvec3> to_light;
    std::size_t directions_a_light = 1;

    // The same, where light has random dimensions.
    std::vector<sample::SampleId> ids;
    std::vector<glm::dmat3> to_sky;  // from the surface's axes to those in which the sky lies; empty where they agree
    int depth = 0;                   // how often light was reflected between these rays and the eye's

    // cull_rays: the rays, by cells of the screen that share windows and zones; empty where nothing is known of them.
    std::vector<trace::WindowedRays> windowed;
    std::vector<std::span<const accel::Zone>> zones;  // of each of `windowed`

    // stop_at_water: of each ray, how far it is to the water; infinite: does not come to it. Empty: there is none.
    std::vector<double> to_water;

    // trace_rays: of each sample.
    std::vector<trace::Hit> hits;
    trace::WindowTracerWork window_work;
    OpenRays open;

    // resolve_hits: of each sample that hit.
    std::vector<std::uint32_t> sample;  // which it is, by index in the arrays above
    std::vector<trace::Hit> surface_hits;
    std::vector<glm::dvec3> x, noise_shift;  // the latter empty where nothing drifts
    std::vector<glm::vec3> normal;           // outward, of unit length

    // light_bed, of hits under water: what of light l is left at them and is worth from there to the eye, from
    // [l * hits] on, and last, for l = lights, of sky rays. Empty: all of it.
    std::vector<glm::vec3> arrives;

    // light_hits.
    std::vector<glm::dvec3> to_disc;  // a point of light l from the hits: from [l * hits] on; empty: lights are points
    ShadowRays shadow;
    std::vector<float> visibility;              // light l's from the hits, from [l * hits] on; empty: all see all
    std::vector<double> height, up_dot_normal;  // of each hit: ShadingPoint
    std::vector<shaders::SurfaceLook> looks;    // of each hit; empty unless the material is rough
    std::vector<glm::vec3> light;               // radiance that a white Lambert surface would have at each hit
    std::vector<glm::vec3> radiance;            // of each sample

    // gather_sky: the hits' sky rays, and how much of their radiance arrives.
    std::unique_ptr<SurfaceChunk> next;
    std::vector<float> weight;  // of each sample, if it is such a ray

    // cast_shafts: rays from the fog to the sun, whose owners are samples, and the sunlight that the fog sends along
    // each sample's way to the eye. Empty: the fog has no shafts.
    ShadowRays shaft;
    std::vector<glm::vec3> in_fog;

    // light_water: of rays that end there, in the samples' order, the chunks of their mirrored and refracted rays, and
    // one of the water itself as a surface.
    std::vector<WaterHit> water;
    std::unique_ptr<SurfaceChunk> mirrored, bed, face;

    const glm::vec3& arriving(std::size_t l, std::size_t i) const { return arrives[l * sample.size() + i]; }
    const glm::dvec3& view_of(std::size_t i) const { return view.empty() ? rays[i].direction : view[i]; }
    const glm::dvec3& to_light_of_hit(std::size_t l, std::size_t i) const {
        if (!to_disc.empty()) return to_disc[l * sample.size() + i];
        return middle_of_light(l, i);
    }
    const glm::dvec3& middle_of_light(std::size_t l, std::size_t i) const {
        return to_light[l * directions_a_light + (directions_a_light == 1 ? 0 : sample[i])];
    }
    std::span<float> visibility_of(std::size_t l) {
        return visibility.empty() ? std::span<float>()
                                  : std::span(visibility).subspan(l * sample.size(), sample.size());
    }
    bool sees_light(std::size_t l, std::size_t i) const {
        return visibility.empty() || visibility[l * sample.size() + i] != 0.0f;
    }
    double time_of(std::size_t i) const { return time.empty() ? 0.0 : time[i]; }
    const trace::Ray& ray_of_hit(std::size_t i) const { return rays[sample[i]]; }

    // What is filled hit by hit would be copied over and over while it grows: 5 to 8 % of a render.
    void reserve(std::size_t count, bool drifts, bool has_shadows) {
        sample.reserve(count);
        surface_hits.reserve(count);
        x.reserve(count);
        if (drifts) noise_shift.reserve(count);
        if (!has_shadows) return;
        shadow.rays.reserve(count);
        shadow.owner.reserve(count);
        shadow.spacing.reserve(count);
    }
};

}  // namespace strata::integrate
