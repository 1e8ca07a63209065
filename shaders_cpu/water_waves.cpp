#include "shaders_cpu/water_waves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "noise/reference.h"
#include "shaders_cpu/filtered_noise.h"

namespace strata::shaders {

namespace {

constexpr int kWaveOctaves = 8;
constexpr double kWaveRatio = 1.83;  // of neighbouring octaves' frequencies

// Mean over the plane of the 2-D noise's squared gradient, per lattice cell: by 12e6 random points, to 1 part in 1000.
constexpr double kMeanGradient2InPlane = 0.783;

// What is finer than the last octave has as much slope as one of them: spectra of slopes are about even by octaves of
// length, down to the shortest ripples.
constexpr double kShares = kWaveOctaves + 1.0;

// Beyond so many deviations a Gaussian has nothing that a double in (0,1) of 32 bits could draw.
constexpr double kFarOut = 8.0;
// An eye is not taken to be turned away from the mean slope by more deviations: there is no facet left to see.
constexpr double kMostTurnedAway = -3.0;

double gaussian(double t) { return std::exp(-0.5 * t * t) * (std::numbers::inv_sqrtpi / std::numbers::sqrt2); }
double gaussian_below(double t) { return 0.5 * std::erfc(-t / std::numbers::sqrt2); }

// The integral over t' < t of (most - t') times the Gaussian; t <= most.
double seen_below(double t, double most) { return most * gaussian_below(t) + gaussian(t); }

// t by the density (most - t) times the Gaussian, t < most: Newton's iteration, kept within a bracket by halving.
double draw_seen(double most, double u) {
    double low = -kFarOut, high = std::min(most, kFarOut), t = std::min(0.0, 0.5 * (low + high));
    const double wanted = u * seen_below(high, most);
    for (int i = 0; i < 60 && high - low > 1e-13; ++i) {
        const double off = seen_below(t, most) - wanted;
        (off > 0.0 ? high : low) = t;
        const double slope = (most - t) * gaussian(t), next = t - off / slope;
        const bool is_inside = slope > 0.0 && next > low && next < high;
        const double previous = t;
        t = is_inside ? next : 0.5 * (low + high);
        if (std::abs(t - previous) < 1e-12) break;
    }
    return t;
}

}  // namespace

double mean_square_slope(double wind_m_s) {
    const double calm = std::min(wind_m_s, 1.0);
    return (0.003 + 0.00512 * wind_m_s) * calm * calm;
}

WaterWaves::WaterWaves(double wind_m_s, double longest) {
    const double of_octave = mean_square_slope(wind_m_s) / kShares;
    if (of_octave <= 0.0) return;
    octave_variance_ = finest_variance_ = 0.5 * of_octave;
    const double frequency = 2.0 / longest;  // a wave is about two cells long
    octaves_ = noise::make_octaves({.octaves = kWaveOctaves,
                                    .lacunarity = kWaveRatio,
                                    .gain = 1.0 / kWaveRatio,
                                    .amplitude = std::sqrt(of_octave / kMeanGradient2InPlane) / frequency,
                                    .frequency = frequency,
                                    .seed = 11});
    glm::dvec2 turn(1.0, 0.0);
    for (int k = 0; k < kWaveOctaves; ++k) {
        turns_.push_back(turn);
        turn = glm::dvec2(0.8 * turn.x - 0.6 * turn.y, 0.6 * turn.x + 0.8 * turn.y);
    }
}

WaveSlopes WaterWaves::at(const glm::dvec3& x, double footprint) const {
    WaveSlopes sum{.mean = glm::dvec2(0.0), .variance = finest_variance_};
    for (std::size_t k = 0; k < octaves_.size(); ++k) {
        const noise::Octave& octave = octaves_[k];
        const double cells = octave.frequency * footprint;
        const double share = whole_share(cells);
        sum.variance += (1.0 - share * share) * octave_variance_;
        if (share <= 0.0) continue;
        const glm::dvec2& turn = turns_[k];
        const noise::Point<2> at{octave.frequency * (turn.x * x.x + turn.y * x.z) + octave.offset[0],
                                 octave.frequency * (turn.x * x.z - turn.y * x.x) + octave.offset[1]};
        const auto gradient = noise::reference_jet<2>(octave.key, noise::split_position<2>(at)).gradient;
        const double scale = share * octave.amplitude * octave.frequency;
        sum.mean += scale * glm::dvec2(turn.x * gradient[0] - turn.y * gradient[1],
                                       turn.y * gradient[0] + turn.x * gradient[1]);
    }
    return sum;
}

// A facet of slope s has the area dot(to_eye, (-s.x, 1, -s.y)) across the eye's direction: with t the slope's part
// towards the eye over the mean, in deviations, c - h d t, c being that of the mean slope.
VisibleFacets::VisibleFacets(const WaveSlopes& slopes, const glm::dvec3& to_eye) : slopes_(slopes) {
    const double level = std::hypot(to_eye.x, to_eye.z);
    to_eye_ = level > 0.0 ? glm::dvec2(to_eye.x, to_eye.z) / level : glm::dvec2(1.0, 0.0);
    const double of_mean = to_eye.y - glm::dot(slopes.mean, glm::dvec2(to_eye.x, to_eye.z));
    const double spread = level * std::sqrt(slopes.variance);
    constexpr double kAll = 1e9;  // so few are turned away that none is drawn
    most_ = spread * kAll > std::abs(of_mean) ? std::max(of_mean / spread, kMostTurnedAway) : kAll;
    area_ = most_ < kAll ? spread * seen_below(most_, most_) : std::max(of_mean, 0.0);
}

glm::dvec2 VisibleFacets::draw(double u, double v) const {
    const double deviation = std::sqrt(slopes_.variance);
    if (deviation == 0.0) return slopes_.mean;
    const double towards = deviation * draw_seen(most_, u), across = deviation * draw_seen(1e9, v);
    return slopes_.mean + towards * to_eye_ + across * glm::dvec2(-to_eye_.y, to_eye_.x);
}

double VisibleFacets::density(const glm::dvec2& slope) const {
    if (slopes_.variance <= 0.0) return 0.0;
    const glm::dvec2 off = slope - slopes_.mean;
    constexpr double kNothing = 60.0;  // 1e-26 of the most
    const double half_deviations2 = 0.5 * glm::dot(off, off) / slopes_.variance;
    if (half_deviations2 > kNothing) return 0.0;
    return std::exp(-half_deviations2) / (2.0 * std::numbers::pi * slopes_.variance);
}

// Facets of slope s lie within ds there on density(s) ds of the level, and mirror a beam to within 4 cos(h) dw(h) of
// the eye's direction, h being their normal and dw(h) = h.y^3 ds; so the level's radiance is density / (4 area h.y^4).
// A disc of radius r is that of normals of radius r / 2, of the variance r^2 / 16 along an axis.
double mirrored_beam(const WaveSlopes& slopes, const glm::dvec3& to_eye, const glm::dvec3& to_light, double radius) {
    const glm::dvec3 normal = glm::normalize(to_eye + to_light);
    constexpr double kSteepest = 0.05;  // normals' least height: no wave is that steep
    if (!(normal.y > kSteepest)) return 0.0;
    WaveSlopes seen = slopes;
    seen.variance += radius * radius / 16.0;
    const VisibleFacets facets(seen, to_eye);
    const double area = facets.area();
    if (!(area > 0.0)) return 0.0;
    const double y2 = normal.y * normal.y;
    const double radiance = facets.density(glm::dvec2(-normal.x, -normal.z) / normal.y) / (4.0 * area * y2 * y2);
    const double sine = std::sin(radius);
    return radius > 0.0 ? std::min(radiance, std::numbers::inv_pi / (sine * sine)) : radiance;
}

}  // namespace strata::shaders
