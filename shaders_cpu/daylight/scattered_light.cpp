#include "shaders_cpu/daylight/scattered_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace strata::shaders {
namespace {

constexpr int kHeights = 24;    // as the square of their number
constexpr int kSunsBelow = 32;  // even in `up`, since twilight falls by e in one or two degrees
constexpr int kSunsAbove = 20;  // as the square
constexpr int kSuns = kSunsBelow + kSunsAbove + 1;
constexpr double kDarkUp = -0.3;  // 17 degrees below the horizon: no light
constexpr int kUpAzimuths = 6;
constexpr int kSteps = 24;

// Gauss and Legendre's eight nodes and weights on [0,1]; the other four are mirror images.
constexpr std::array<double, 4> kNode = {0.019855071751231856, 0.10166676129318664, 0.2372337950418355,
                                         0.40828267875217505};
constexpr std::array<double, 4> kWeight = {0.05061426814518813, 0.11119051722668717, 0.15685332293894369,
                                           0.18134189168918102};

double node(int k) { return k < 4 ? kNode[k] : 1.0 - kNode[7 - k]; }
double weight(int k) { return kWeight[k < 4 ? k : 7 - k]; }

double height_of(int i) {
    const double x = static_cast<double>(i) / (kHeights - 1);
    return kAirTop * x * x;
}

double sun_up_of(int k) {
    if (k < kSunsBelow) return kDarkUp * (1.0 - static_cast<double>(k) / kSunsBelow);
    const double x = static_cast<double>(k - kSunsBelow) / kSunsAbove;
    return x * x;
}

Cell sun_cell(double sun_up) {
    if (sun_up >= 0.0) {
        Cell cell = cell_of(std::sqrt(sun_up), kSunsAbove + 1);
        cell.index += kSunsBelow;
        return cell;
    }
    return cell_of(1.0 - sun_up / kDarkUp, kSunsBelow + 1);
}

glm::vec4 at(const std::vector<glm::vec4>& row, double sun_up) {
    const Cell cell = sun_cell(sun_up);
    return blend(row[cell.index], row[cell.index + 1], cell.fraction);
}

}  // namespace

// Gathers, at one height and from one cone of directions, the light of one order that is scattered once more on its
// way.
class ScatteredLight::Gatherer {
  public:
    Gatherer(const AirModel& medium, double height, double up)
        : medium_(medium),
          up_(up),
          path_(medium, height, up, distance_to_ground(height, up), kSteps),
          meets_ground_(distance_to_ground(height, up) < std::numeric_limits<double>::infinity()) {}

    // Sunlight: mean over the azimuth of the radiance that comes from the cone.
    glm::vec4 sunlight(const SunTable& sun, double sun_up) const {
        return mean_over_azimuth(sun_up, [&](double cosine) {
            const double rayleigh = AirModel::rayleigh_phase(cosine);
            constexpr double kEven = 1.0 / (4.0 * std::numbers::pi);
            Bands light(0.0);
            for (const AirStep& step : path_.steps())
                light +=
                    (step.air * rayleigh + step.even_haze * kEven) *
                    sun.at(step.sun_cell, step.horizon, local_up(sun_up, cosine, step.distance, step.radius)).diffuse;
            if (meets_ground_) {
                const double ground_up = local_up(sun_up, cosine, path_.length(), kEarthRadius);
                light += of_ground(sun.at({0, 0.0f}, 0.0, ground_up).diffuse * std::max(0.0, ground_up));
            }
            return glm::vec4(light);
        });
    }

    // Light that has been scattered before. Rows of the path's heights are blended once for all suns.
    void prepare(const Field& before) {
        rows_.resize(path_.steps().size());
        for (std::size_t s = 0; s < rows_.size(); ++s) {
            const AirStep& step = path_.steps()[s];
            const Row& low = before.mean[step.diffuse_cell.index];
            const Row& high = before.mean[step.diffuse_cell.index + 1];
            const glm::vec4 share(step.air + step.even_haze);
            rows_[s].resize(kSuns);
            for (int k = 0; k < kSuns; ++k) rows_[s][k] = share * blend(low[k], high[k], step.diffuse_cell.fraction);
        }
    }

    glm::vec4 scattered(const Field& before, double sun_up) const {
        return mean_over_azimuth(sun_up, [&](double cosine) {
            glm::vec4 light(0.0f);
            for (std::size_t s = 0; s < rows_.size(); ++s) {
                const AirStep& step = path_.steps()[s];
                light += at(rows_[s], local_up(sun_up, cosine, step.distance, step.radius));
            }
            if (meets_ground_) {
                const double ground_up = local_up(sun_up, cosine, path_.length(), kEarthRadius);
                light += glm::vec4(of_ground(Bands(at(before.ground, ground_up))));
            }
            return light;
        });
    }

  private:
    double local_up(double sun_up, double cosine, double distance, double radius) const {
        return (path_.start_radius() * sun_up + distance * cosine) / radius;
    }

    Bands of_ground(const Bands& irradiance) const {
        return path_.diffuse_transmittance() * irradiance * (medium_.ground_albedo() / std::numbers::pi);
    }

    template <class Radiance>
    glm::vec4 mean_over_azimuth(double sun_up, const Radiance& radiance) const {
        const double level = std::sqrt(std::max(0.0, (1.0 - up_ * up_) * (1.0 - sun_up * sun_up)));
        glm::vec4 sum(0.0f);
        for (int a = 0; a < kUpAzimuths; ++a)
            sum += radiance(up_ * sun_up + level * std::cos((a + 0.5) / kUpAzimuths * std::numbers::pi));
        return sum / static_cast<float>(kUpAzimuths);
    }

    const AirModel& medium_;
    double up_;
    AirPath path_;
    bool meets_ground_;
    std::vector<Row> rows_;
};

ScatteredLight::Field ScatteredLight::no_light() {
    const Row dark(kSuns, glm::vec4(0.0f));
    return {std::vector<Row>(kHeights, dark), dark};
}

ScatteredLight::ScatteredLight(const AirModel& medium, const SunTable& sun, int orders, Rest rest) : sum_(no_light()) {
    Field before = no_light();
    for (int order = 1; order <= orders; ++order) {
        Field now = no_light();
        for (int i = 0; i < kHeights; ++i) {
            const double horizon = horizon_up(height_of(i));
            for (int k = 0; k < 16; ++k) {
                // Directions crowd at the horizon, eight above and eight below.
                const double x = node(k % 8);
                const double reach = k < 8 ? 1.0 - horizon : -1.0 - horizon;
                const double up = horizon + reach * x * x;
                const double share = std::fabs(reach) * x * weight(k % 8);  // of the whole sphere
                Gatherer gatherer(medium, height_of(i), up);
                if (order > 1) gatherer.prepare(before);
                for (int s = 0; s < kSuns; ++s) {
                    const glm::vec4 radiance =
                        order == 1 ? gatherer.sunlight(sun, sun_up_of(s)) : gatherer.scattered(before, sun_up_of(s));
                    now.mean[i][s] += radiance * static_cast<float>(share);
                    if (i == 0 && k < 8)
                        now.ground[s] += radiance * static_cast<float>(share * 4.0 * std::numbers::pi * up);
                }
            }
        }
        add(now, before, order == orders && rest == Rest::kSeries);
        before = std::move(now);
    }
}

void ScatteredLight::add(const Field& order, const Field& before, bool with_rest) {
    const auto add_row = [&](Row& sum, const Row& now, const Row& then) {
        for (int s = 0; s < kSuns; ++s)
            for (int b = 0; b < 4; ++b) {
                // A ratio close to 1 would only be noise of what is next to nothing.
                const float ratio = then[s][b] > 0.0f ? std::min(now[s][b] / then[s][b], 0.9f) : 0.0f;
                sum[s][b] += with_rest ? now[s][b] / (1.0f - ratio) : now[s][b];
            }
    };
    for (int i = 0; i < kHeights; ++i) add_row(sum_.mean[i], order.mean[i], before.mean[i]);
    add_row(sum_.ground, order.ground, before.ground);
}

Cell ScatteredLight::height_cell(double height) {
    return cell_of(std::sqrt(std::max(height, 0.0) / kAirTop), kHeights);
}

Bands ScatteredLight::mean_radiance(const Cell& height, double sun_up) const {
    return Bands(blend(at(sum_.mean[height.index], sun_up), at(sum_.mean[height.index + 1], sun_up), height.fraction));
}

Bands ScatteredLight::ground_irradiance(double sun_up) const { return Bands(at(sum_.ground, sun_up)); }

}  // namespace strata::shaders
