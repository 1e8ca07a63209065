#include "src/accel/screen_beams.h"

#include <algorithm>
#include <cmath>

#include "src/scene/needs.h"
#include "src/trace/rounding_pad.h"

namespace strata::accel {

namespace {

// The finest cells hold about this many rays at most: with fewer a beam costs more than it saves. Speed only.
constexpr double kRaysALeaf = 6.25;

// Cells are no longer in time than the surface takes to move by this fraction of their side. Speed only.
constexpr double kBlurASide = 0.5;

double rays_a_pixel(const scene::Sampling& sampling) {
    return sampling.estimator == scene::EstimatorKind::none ? 1.0 : static_cast<double>(sampling.N) * sampling.N;
}

scene::TimeSpan shutter(const scene::Scene& scene) { return scene::open_shutter(scene); }

double time_cells(double blur, double leaf) { return std::max(1.0, blur / (kBlurASide * leaf)); }

// The largest power of two of pixels with few enough rays, with the scene's motion divided to suit.
double leaf_side(const scene::Scene& scene, double blur) {
    const double rays = rays_a_pixel(scene.sampling);
    double leaf = 64.0;
    while (leaf > 0x1p-6 && rays * leaf * leaf / time_cells(blur, leaf) > kRaysALeaf) leaf *= 0.5;
    const double least = std::exp2(std::ceil(std::log2(std::max(scene.film.width, scene.film.height) * 0x1p-23)));
    return std::max(leaf, least);
}

int time_bits(const scene::Scene& scene, double blur, double leaf) {
    if (!scene::needs_time_samples(scene)) return 0;
    return static_cast<int>(std::ceil(std::log2(time_cells(blur, leaf))));
}

ScreenHierarchy hierarchy(const scene::Scene& scene, const CellBeams& around) {
    const double blur = scene::needs_time_samples(scene) ? around.blur(shutter(scene)) : 0.0;
    const double leaf = leaf_side(scene, blur);
    return {leaf, time_bits(scene, blur, leaf), shutter(scene)};
}

}  // namespace

ScreenBeams::ScreenBeams(const scene::Scene& scene, const scene::CameraPath& path, const trace::Placement& placement,
                         const trace::Field& field)
    : around_(scene, path, placement, field),
      tracer_(field),
      windows_(
          field,
          scene.sampling.tolerance *
              trace::Camera(path.at(0.0), scene.film).ray(0.5 * scene.film.width, 0.5 * scene.film.height).pixel_angle),
      hierarchy_(hierarchy(scene, around_)) {}

// Every cell that holds samples is wanted. What a node has reached is a distance from the eye.
class ScreenBeams::Descent {
  public:
    using Frame = CellBeam::Margins;

    Descent(const ScreenBeams& beams, BeamedSamples& out) : beams_(beams), out_(out) {}

    int levels() const { return beams_.hierarchy_.levels(); }
    std::span<const std::uint64_t> codes() const { return out_.samples.codes; }
    int shift(int level) const { return beams_.hierarchy_.shift(level); }
    bool is_wanted(int /*level*/, std::uint32_t /*first*/, std::uint32_t /*last*/) const { return true; }

    // Where no beam fits around the cell, one with a limit of 0 stands for it, which the tracer leaves at once.
    trace::Beam place(int level, std::uint64_t code, const CellNode& parent, Frame& margins) const {
        const CellBeam cell = beams_.around_.around(beams_.hierarchy_.cell(code, level)).value_or(CellBeam{});
        margins = cell.margins;
        trace::Beam beam = cell.beam;
        beam.start = std::max(beam.start, parent.reached * margins.cosine * trace::kSooner);
        return beam;
    }

    // Cells of the finest level, and those whose rays meet nothing, are done.
    bool note(int level, CellNode& node, const Frame& margins, const trace::Beam& beam, const trace::BeamEnd& end) {
        const bool is_beam = beam.limit > 0.0;
        if (is_beam) {
            node.reached = std::max(node.reached, (end.s - margins.shift) * trace::kSooner);
            node.hint = end.hint;
        }
        const bool misses = is_beam && end.misses;
        if (level > 0 && !misses) return true;
        BeamedCell& cell = out_.cells.emplace_back(BeamedCell{node.first, node.last, misses, node.reached, node.hint});
        if (is_beam && !misses) {
            cell.leaf = static_cast<std::int32_t>(out_.leaves.size());
            out_.leaves.push_back({{beam, margins}, end.s, end.slope});
        }
        return false;
    }

  private:
    const ScreenBeams& beams_;
    BeamedSamples& out_;
};

void ScreenBeams::trace(std::span<const double> u, std::span<const double> v, std::span<const double> t,
                        BeamedSamples& out, trace::TraceCounters& counters) const {
    out.samples.codes.resize(u.size());
    hierarchy_.codes(u, v, t, out.samples.codes);
    out.samples.sort();
    out.cells.clear();
    out.leaves.clear();
    Descent descent(*this, out);
    descend(descent, 0.0, tracer_, out.tree, counters);
    // Mostly all are of the finest level, and in order.
    if (!std::ranges::is_sorted(out.cells, {}, &BeamedCell::first))
        std::ranges::sort(out.cells, {}, &BeamedCell::first);
}

void ScreenBeams::open_windows(const BeamedSamples& beamed, std::span<const BeamedCell> cells, WindowChains& out,
                               trace::TraceCounters& counters) const {
    out.chains.clear();
    for (const BeamedCell& cell : cells) {
        WindowChain& chain = out.chains.emplace_back();
        if (cell.leaf < 0) continue;
        const BeamedSamples::Leaf& leaf = beamed.leaves[static_cast<std::size_t>(cell.leaf)];
        chain = {.cell = &leaf.cell, .s = leaf.end, .slope = leaf.slope};
    }
    windows_.build(out, counters);
}

}  // namespace strata::accel
