#include "src/integrate/sample_view.h"

#include <algorithm>
#include <limits>

#include "src/integrate/hit_shading.h"
#include "src/integrate/light.h"
#include "src/integrate/medium.h"
#include "src/integrate/place.h"

namespace strata::integrate {

SampleView::SampleView(const SurfaceSetup& setup, const SampleBatch& batch, const SurfaceChunk& chunk)
    : setup_(&setup),
      batch_(&batch),
      chunk_(&chunk),
      radiance_(chunk.radiance.empty() ? glm::vec3(0.0f) : chunk.radiance.front()),
      costs_(costs_of(setup, chunk)) {}

// Normals take the octaves that were missing from the hits' gradients.
std::vector<SampleView::Cost> SampleView::costs_of(const SurfaceSetup& setup, const SurfaceChunk& chunk) {
    std::vector<Cost> costs;
    costs.reserve(chunk.rays.size());
    for (std::size_t i = 0; i < chunk.rays.size(); ++i) {
        costs.push_back({chunk.hits[i].steps, chunk.hits[i].noise_evaluations});
    }
    for (std::size_t i = 0; i < chunk.sample.size(); ++i) {
        const trace::Hit& hit = chunk.surface_hits[i];
        if (!hit.on_bound) costs[chunk.sample[i]].noise_evaluations += setup.field.evaluations() - hit.octaves;
    }
    for (std::size_t i = 0; i < chunk.shadow.hits.size(); ++i) {
        Cost& cost = costs[chunk.sample[chunk.shadow.owner[i]]];
        cost.steps += chunk.shadow.hits[i].steps;
        cost.noise_evaluations += chunk.shadow.hits[i].noise_evaluations;
    }
    for (std::size_t i = 0; i < chunk.shaft.hits.size(); ++i) {
        Cost& cost = costs[chunk.shaft.owner[i]];
        cost.steps += chunk.shaft.hits[i].steps;
        cost.noise_evaluations += chunk.shaft.hits[i].noise_evaluations;
    }
    if (chunk.depth == 0 && !chunk.water.empty()) add_costs_of_water(setup, chunk, costs);
    if (!setup.has_sky_rays || chunk.depth > setup.scene.sky.bounces) return costs;
    const std::vector<Cost> of_sky_rays = costs_of(setup, *chunk.next);
    for (std::size_t i = 0; i < chunk.sample.size(); ++i) {
        costs[chunk.sample[i]].steps += of_sky_rays[i].steps;
        costs[chunk.sample[i]].noise_evaluations += of_sky_rays[i].noise_evaluations;
    }
    return costs;
}

void SampleView::add_costs_of_water(const SurfaceSetup& setup, const SurfaceChunk& chunk, std::vector<Cost>& costs) {
    const auto add = [&](std::size_t water, std::uint64_t steps, std::uint64_t evaluations) {
        Cost& cost = costs[chunk.water[water].sample];
        cost.steps += steps;
        cost.noise_evaluations += evaluations;
    };
    for (const SurfaceChunk* rays : {chunk.mirrored.get(), chunk.bed.get()}) {
        const std::vector<Cost> each = costs_of(setup, *rays);
        for (std::size_t i = 0; i < each.size(); ++i) add(i, each[i].steps, each[i].noise_evaluations);
    }
    const ShadowRays& shadow = chunk.face->shadow;
    for (std::size_t i = 0; i < shadow.hits.size(); ++i)
        add(chunk.face->sample[shadow.owner[i]], shadow.hits[i].steps, shadow.hits[i].noise_evaluations);
}

// Hits are in the samples' order, and so is what ended on water.
void SampleView::next() {
    if (is_hit()) ++hit_;
    if (is_water()) ++water_;
    if (++sample_ < chunk_->radiance.size()) radiance_ = chunk_->radiance[sample_];
}

bool SampleView::is_water() const {
    return chunk_ != nullptr && water_ < chunk_->water.size() && chunk_->water[water_].sample == sample_;
}

double SampleView::way() const {
    if (is_water()) return chunk_->hits[sample_].s;
    return is_hit() ? chunk_->surface_hits[hit_].s : std::numeric_limits<double>::infinity();
}

double SampleView::distance() const { return is_hit() || is_water() ? way() * setup_->placement.scale() : kNothing; }

double SampleView::depth() const {
    if (!is_hit() && !is_water()) return kNothing;
    return distance() * glm::dot(direction(), camera_at(*setup_, time()).view_axis());
}

glm::dvec3 SampleView::direction() const {
    return setup_->placement.orientation(time()) * chunk_->rays[sample_].direction;
}

glm::dvec3 SampleView::position() const {
    if (!is_hit() && !is_water()) return glm::dvec3(0.0);
    const glm::dvec3& x = is_water() ? chunk_->water[water_].x : chunk_->x[hit_];
    return setup_->placement.point_to_world(setup_->placement.orientation(time()), x);
}

glm::dvec3 SampleView::normal() const {
    if (!is_hit() && !is_water()) return glm::dvec3(0.0);
    const glm::dvec3 normal = is_water() ? chunk_->water[water_].normal : glm::dvec3(chunk_->normal[hit_]);
    return setup_->placement.orientation(time()) * normal;
}

glm::vec3 SampleView::reflectance() const {
    if (!is_hit()) return glm::vec3(0.0f);
    const auto reflect = [&](const auto& material) { return reflectance_of(material, *setup_, *chunk_, hit_); };
    return std::visit(reflect, setup_->material);
}

double SampleView::height_mask() const {
    if (!is_hit()) return 0.0;
    const shaders::ShadingPoint point = shading_point(*chunk_, hit_);
    const auto mask = [&](const auto& material) {
        if constexpr (requires { material.height_mask(point); }) return material.height_mask(point);
        return 0.0;
    };
    return std::visit(mask, setup_->material);
}

double SampleView::slope_mask() const {
    if (!is_hit()) return 0.0;
    const shaders::ShadingPoint point = shading_point(*chunk_, hit_);
    const auto mask = [&](const auto& material) {
        if constexpr (requires { material.slope_mask(point); }) return material.slope_mask(point);
        return 0.0;
    };
    return std::visit(mask, setup_->material);
}

void SampleView::ground_shares(std::span<float> shares) const {
    std::ranges::fill(shares, 0.0f);
    if (!is_hit()) return;
    const auto find = [&](const auto& material) {
        if constexpr (requires { material.shares({}, shares); })
            material.shares(detailed_point(*setup_, *chunk_, hit_), shares);
    };
    std::visit(find, setup_->material);
}

bool SampleView::is_miss() const { return chunk_ != nullptr && chunk_->hits[sample_].state == trace::HitState::miss; }

// look(segment) of each medium between the eye and the hit, or before the background.
template <class Look>
void SampleView::look_through_media(const Look& look) const {
    const shaders::MediumRay ray = medium_ray(*setup_, *chunk_, sample_, way());
    const auto look_through = [&]<class Member>(const Member& member) {
        if (is_hit() || is_water() || Member::kBeforeBackground) look(member.along(ray));
    };
    for (const shaders::Medium& medium : setup_->media) std::visit(look_through, medium);
}

// What the hit's sky ray brought (sky_rays.cpp).
glm::vec3 SampleView::sky_ray_light(shaders::LightLayer layer) const {
    const SurfaceChunk& next = *chunk_->next;
    const trace::HitState state = next.hits[hit_].state;
    const float weight = next.weight[hit_];
    if (weight == 0.0f) return glm::vec3(0.0f);
    if (layer == shaders::LightLayer::sky && state == trace::HitState::miss) {
        const auto gain =
            static_cast<float>(std::visit([](const auto& sky) { return sky.gain(); }, setup_->background));
        return next.radiance[hit_] * (gain * weight);
    }
    const bool is_ground = state == trace::HitState::hit || state == trace::HitState::water;
    const bool is_lit = is_ground && next.depth <= setup_->scene.sky.bounces;
    return layer == shaders::LightLayer::bounce && is_lit ? next.radiance[hit_] * weight : glm::vec3(0.0f);
}

glm::vec3 SampleView::reflected(shaders::LightLayer layer) const {
    if (!is_hit()) return glm::vec3(0.0f);
    glm::vec3 light(0.0f);
    for (std::size_t l = 0; l < setup_->lights.size(); ++l) {
        if (!chunk_->sees_light(l, hit_)) continue;
        const auto add = [&]<class Member>(const Member& member) {
            if (Member::kLayer == layer) light += light_on_white(member, *chunk_, l, hit_);
        };
        std::visit(add, setup_->lights[l].light);
    }
    if (setup_->has_sky_rays) light += sky_ray_light(layer);
    glm::vec3 seen = reflectance() * light;
    look_through_media([&](const shaders::MediumSegment& segment) { seen *= segment.transmittance; });
    return seen;
}

glm::vec3 SampleView::inscatter() const {
    glm::vec3 seen(0.0f);
    if (!is_hit() && !is_water() && !is_miss()) return seen;
    look_through_media([&](const shaders::MediumSegment& segment) { seen = segment.over(seen); });
    return seen;
}

glm::vec3 SampleView::water() const {
    if (!is_water()) return glm::vec3(0.0f);
    glm::vec3 seen = chunk_->water[water_].radiance;
    look_through_media([&](const shaders::MediumSegment& segment) { seen *= segment.transmittance; });
    return seen;
}

glm::vec3 SampleView::background() const {
    if (is_hit() || is_water()) return glm::vec3(0.0f);
    if (!is_miss()) return radiance_;
    const glm::dvec3& direction = chunk_->view_of(sample_);
    glm::vec3 seen = std::visit([&](const auto& member) { return member.radiance(direction); }, setup_->background);
    look_through_media([&](const shaders::MediumSegment& segment) { seen *= segment.transmittance; });
    return seen;
}

double SampleView::cloud_opacity() const {
    if (!is_hit() && !is_water() && !is_miss()) return 0.0;
    return setup_->clouds ? setup_->clouds->opacity(medium_ray(*setup_, *chunk_, sample_, way())) : 0.0;
}

double SampleView::sun_visibility() const {
    if (!is_hit()) return 0.0;
    for (std::size_t l = 0; l < setup_->lights.size(); ++l) {
        const auto is_sun = []<class Member>(const Member&) { return Member::kLayer == shaders::LightLayer::sun; };
        if (!std::visit(is_sun, setup_->lights[l].light)) continue;
        const bool is_before = glm::dot(glm::dvec3(chunk_->normal[hit_]), chunk_->to_light_of_hit(l, hit_)) > 0.0;
        return is_before && chunk_->sees_light(l, hit_) ? 1.0 : 0.0;
    }
    return 0.0;
}

// Where what is seen will be on the screen a frame later. Noise is evaluated at x + noise_shift(t): what has a place in
// it moves against the shift.
std::optional<glm::dvec2> SampleView::next_place() const {
    const double now = time(), next = now + 1.0 / setup_->scene.shutter.fps;
    const trace::Camera camera = camera_at(*setup_, next);
    if (!is_hit() && !is_water()) return camera.on_screen(direction());
    if (is_water()) return camera.on_screen(position() - camera.position());
    const glm::dvec3 x = chunk_->x[hit_] + setup_->field.noise_shift(now) - setup_->field.noise_shift(next);
    const glm::dmat3 orientation = setup_->placement.orientation(next);
    return camera.on_screen(setup_->placement.point_to_world(orientation, x) - camera.position());
}

glm::dvec2 SampleView::motion() const {
    if (chunk_ == nullptr) return glm::dvec2(0.0);
    if (!setup_->path.moves() && !setup_->placement.moves() && !setup_->field.drifts()) return glm::dvec2(0.0);
    const std::optional<glm::dvec2> next = next_place();
    const std::uint32_t sample = chunk_->order[sample_];
    return next ? glm::dvec2(next->x - batch_->u[sample], batch_->v[sample] - next->y) : glm::dvec2(0.0);
}

std::uint64_t SampleView::steps() const { return chunk_ == nullptr ? 0 : costs_[sample_].steps; }

std::uint64_t SampleView::noise_evaluations() const {
    return chunk_ == nullptr ? 0 : costs_[sample_].noise_evaluations;
}

}  // namespace strata::integrate
