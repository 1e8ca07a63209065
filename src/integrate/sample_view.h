// One sample of a picture as the rows of channel_table.cpp see it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "src/integrate/image_function.h"
#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

class SampleView {
  public:
    // A sample of a picture that traces nothing.
    explicit SampleView(const glm::vec3& radiance) : radiance_(radiance) {}

    // The first sample of a chunk of the batch, which went through all stages. All outlive the view.
    SampleView(const SurfaceSetup& setup, const SampleBatch& batch, const SurfaceChunk& chunk);

    // Goes on to the chunk's next sample.
    void next();

    const glm::vec3& radiance() const { return radiance_; }

    // Whether its ray met the surface. What follows is in the world, at the sample's own time.
    bool is_hit() const { return chunk_ != nullptr && hit_ < chunk_->sample.size() && chunk_->sample[hit_] == sample_; }

    // Whether it ended on level water, of which what is said of a hit's place is said, too.
    bool is_water() const;

    // Of the hit, from the eye: along the ray, and along the camera's view axis. kNothing for other samples.
    double distance() const;
    double depth() const;
    static constexpr double kNothing = 1e10;

    // Of the hit; 0 for other samples. The normal is of unit length and points outward.
    glm::dvec3 position() const;
    glm::dvec3 normal() const;

    // Of the hit's material, linear RGB; and weights of its parts, in [0,1], of a material that has
    // such. 0 for other samples.
    glm::vec3 reflectance() const;
    double height_mask() const;
    double slope_mask() const;

    // What each layer of ground covers of the hit, in [0,1]: they sum to 1. 0 for other samples.
    void ground_shares(std::span<float> shares) const;

    // The light of one layer that the hit reflects, and what the media before it add, as the eye sees it.
    // 0 for other samples.
    glm::vec3 reflected(shaders::LightLayer layer) const;
    glm::vec3 inscatter() const;

    // Radiance of a sample that ended on water, as the eye sees it; 0 for other samples.
    glm::vec3 water() const;

    // Radiance of a sample that hits nothing; 0 for hits.
    glm::vec3 background() const;

    // What clouds before the hit or the sky hide of it, in [0,1].
    double cloud_opacity() const;

    // 1: the sun's direction is before the hit and free; 0: not, and for other samples.
    double sun_visibility() const;

    // How far what is seen moves on the screen until the next frame, in pixels to the right and upward: camera, spin
    // and drift of the noise taken together. 0 where it will be behind the camera. The sky is infinitely far away and
    // does not spin.
    glm::dvec2 motion() const;

    // What its ray, its normal, its shadow rays and sky rays took. Beams and windows, which many samples share, are in
    // neither: of a picture's samples these sum up to Counters::steps and noise_evaluations less those of their phases.
    // Exact in float up to 2^24.
    std::uint64_t steps() const;
    std::uint64_t noise_evaluations() const;

  private:
    struct Cost {
        std::uint64_t steps = 0, noise_evaluations = 0;
    };

    // Of each sample of a chunk, with what follows from its hit.
    static std::vector<Cost> costs_of(const SurfaceSetup& setup, const SurfaceChunk& chunk);

    static void add_costs_of_water(const SurfaceSetup& setup, const SurfaceChunk& chunk, std::vector<Cost>& costs);

    double time() const { return batch_->t[chunk_->order[sample_]]; }
    glm::dvec3 direction() const;
    bool is_miss() const;
    double way() const;  // to the hit or water along the ray, surface units
    std::optional<glm::dvec2> next_place() const;
    glm::vec3 sky_ray_light(shaders::LightLayer layer) const;
    template <class Look>
    void look_through_media(const Look& look) const;

    const SurfaceSetup* setup_ = nullptr;
    const SampleBatch* batch_ = nullptr;
    const SurfaceChunk* chunk_ = nullptr;
    std::size_t sample_ = 0;
    std::size_t hit_ = 0;    // the first that is not of a sample before
    std::size_t water_ = 0;  // the same of the water's
    glm::vec3 radiance_;
    std::vector<Cost> costs_;  // of each sample
};

}  // namespace strata::integrate
