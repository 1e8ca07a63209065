#include "src/accel/cell_windows.h"

#include <algorithm>
#include <cmath>

#include "src/trace/rounding_pad.h"

namespace strata::accel {

namespace {

// Speed only, as all constants here but the last. A window's error leaves its rays' hits in a bracket of about error /
// slope, which landings (src/trace/landing.h) narrow where it is well below sqrt(slope / D), D the bound of the third
// derivative over 6: kNearError is that part. Far from the surface the error may be kFarError of f. Slopes are taken to
// be no less than kLeastSlope.
constexpr double kNearError = 0.3;
constexpr double kFarError = 0.2;
constexpr double kLeastSlope = 0.1;

// A window does not lead much further than to where f should have fallen by this part.
constexpr double kFall = 0.6;

// Windows narrower than so many radii of the beam are not worth it; those of so many radii always are.
constexpr double kLeastWidth = 1.15;
constexpr double kWide = 2.0;

// Windows of one cell at most: rays that need more are few, or near no surface.
constexpr int kMostWindows = 8;

// Of positions: covers the rounding of a centre and of a ray's point.
constexpr double kPlace = 0x1p-49;

}  // namespace

// No octaves where no window is worth it.
trace::WindowPlan::Size CellWindows::next_size(const WindowChain& chain) const {
    if (!(plan_.cube() > 0.0)) return {};
    const double beam_radius = trace::radius_at(chain.cell->beam, chain.s);
    const double slope = std::max(std::abs(chain.slope), kLeastSlope);
    const double near = kNearError * slope * std::sqrt(slope / plan_.cube());
    trace::WindowPlan::Size size = plan_.size(std::max(near, kFarError * chain.clearance));
    if (chain.clearance > 0.0 && chain.slope < 0.0) {
        size.radius = std::min(size.radius, std::max(kFall * chain.clearance / -chain.slope, kWide * beam_radius));
    }
    return size.radius > kLeastWidth * beam_radius ? size : trace::WindowPlan::Size{};
}

// Half the length over which all of the beam lies in a ball of that radius about a point of the axis; 0 where it is
// wider than the ball.
double CellWindows::half_length(const trace::Beam& beam, double begin, double ball) const {
    const double reach = glm::length(beam.origin) + glm::length(beam.noise_shift) + begin + 2.0 * ball;
    const double inner = ball - beam.noise_radius - kPlace * reach;
    const double radius = beam.radius0 + beam.spread * (begin + 2.0 * ball);  // no less than at the far end
    if (!(inner > radius)) return 0.0;
    const double half = std::sqrt((inner - radius) * (inner + radius));
    if (!field_.is_planar_noise()) return half;
    // Of the way along the axis the noise sees the horizontal part.
    const double speed = std::hypot(beam.direction.x, beam.direction.z);
    return speed > 0.0 ? std::clamp((inner - radius) / speed, half, ball) : half;
}

// Puts another window at the chain's end. False: none is worth it.
bool CellWindows::extend(WindowChain& chain, std::vector<trace::Window>& windows) const {
    const CellBeam& cell = *chain.cell;
    const trace::Beam& beam = cell.beam;
    const trace::WindowPlan::Size size = next_size(chain);
    if (size.octaves == 0) return false;
    // Rays that come from this distance have at least that axis coordinate.
    const double from = (chain.s - cell.margins.shift) * trace::kSooner,
                 begin = from * cell.margins.cosine * trace::kSooner;
    const double half = half_length(beam, begin, size.radius);
    if (half <= 0.0) return false;

    const auto index = static_cast<std::uint32_t>(windows.size());
    trace::Window& window = windows.emplace_back();
    window.centre = beam.origin + (begin + half) * beam.direction + beam.noise_shift;
    window.from = from;
    window.to = (begin + 2.0 * half - cell.margins.shift) * trace::kSooner;
    window.octaves = size.octaves;
    const glm::dvec3 reach = glm::abs(window.centre);
    window.error = plan_.error(size, std::max({reach.x, reach.y, reach.z}));
    if (chain.length++ == 0) {
        chain.first = index;
    } else {
        windows[chain.last].next = static_cast<std::int32_t>(index - chain.last);
    }
    chain.last = index;
    chain.half = half;
    chain.s = begin + 2.0 * half;
    return true;
}

// Notes what the chain's last window says of f where it ends. False: by then all rays should have hit, or be leaving.
bool CellWindows::goes_on(WindowChain& chain, const trace::Window& window) const {
    const trace::Beam& beam = chain.cell->beam;
    const glm::dvec3 x = window.centre - beam.noise_shift;
    const double f = field_.base(x) - static_cast<double>(window.value);
    const glm::dvec3 gradient = field_.base_gradient(x) - glm::dvec3(window.gradient);
    const double slope = glm::dot(gradient, beam.direction);
    const double across = glm::length(gradient - slope * beam.direction);
    const double spread = across * trace::radius_at(beam, chain.s) + static_cast<double>(window.error);
    const double end = f + slope * chain.half;
    chain.slope = slope;
    chain.clearance = std::max(end - spread, 0.0);
    chain.hits = end + spread < 0.0;
    const bool leave = slope > 0.0 && f > spread;
    return !chain.hits && !leave && chain.length < kMostWindows;
}

void CellWindows::build(WindowChains& out, trace::TraceCounters& counters) const {
    out.open.clear();
    for (std::uint32_t i = 0; i < out.chains.size(); ++i) {
        if (out.chains[i].cell != nullptr) out.open.push_back(i);
    }
    while (!out.open.empty()) {
        const std::size_t begin = out.windows.size();
        std::erase_if(out.open, [&](std::uint32_t i) { return !extend(out.chains[i], out.windows); });
        jets_.evaluate(std::span(out.windows).subspan(begin), counters);
        std::erase_if(out.open,
                      [&](std::uint32_t i) { return !goes_on(out.chains[i], out.windows[out.chains[i].last]); });
    }
}

}  // namespace strata::accel
