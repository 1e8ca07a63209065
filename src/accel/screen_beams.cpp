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

// Cells up to this side, px, are not divided where windows fit around them. Speed only.
constexpr double kWidestWithWindows = 1.0;

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
    : around_(scene, path, placement, field), tracer_(field), windows_(field), hierarchy_(hierarchy(scene, around_)) {}

// Every cell that holds samples is wanted. What a node has reached is a distance from the eye.
class ScreenBeams::Descent {
  public:
    using Frame = ScreenCellFrame;

    Descent(const ScreenBeams& beams, BeamedSamples& out, trace::TraceCounters& window_counters)
        : beams_(beams), out_(out), window_counters_(window_counters) {}

    int levels() const { return beams_.hierarchy_.levels(); }
    std::span<const std::uint64_t> codes() const { return out_.samples.codes; }
    int shift(int level) const { return beams_.hierarchy_.shift(level); }
    bool is_wanted(int /*level*/, std::uint32_t /*first*/, std::uint32_t /*last*/) const { return true; }

    // Where no beam fits around the cell, one with a limit of 0 stands for it, which the tracer leaves at once.
    trace::Beam place(int level, std::uint64_t code, const CellNode& parent, Frame& frame) const {
        const CellBeam cell = beams_.around_.around(beams_.hierarchy_.cell(code, level)).value_or(CellBeam{});
        frame.margins = cell.margins;
        trace::Beam beam = cell.beam;
        beam.start = std::max(beam.start, parent.reached * cell.margins.cosine * trace::kSooner);
        return beam;
    }

    // Windows around the cells whose beams met something.
    void look(int level, CellTree<Frame>& tree) {
        out_.windows.chains.clear();
        out_.chained.clear();
        if (level > 0 && beams_.hierarchy_.side(level) > kWidestWithWindows) return;
        out_.chained.reserve(tree.beams.size());  // chains point to them
        for (std::size_t i = 0; i < tree.beams.size(); ++i) {
            const trace::BeamEnd& end = tree.ends[i];
            if (!(tree.beams[i].limit > 0.0) || end.misses) continue;
            const CellBeam& cell = out_.chained.emplace_back(CellBeam{tree.beams[i], tree.frames[i].margins});
            tree.frames[i].chain = static_cast<std::int32_t>(out_.windows.chains.size());
            out_.windows.chains.push_back({.cell = &cell, .s = end.s, .slope = end.slope});
        }
        beams_.windows_.build(out_.windows, window_counters_);
    }

    // Cells of the finest level, those whose rays meet nothing, and those all of whose rays hit within their windows,
    // are done.
    bool note(int level, CellNode& node, const Frame& frame, const trace::Beam& beam, const trace::BeamEnd& end) {
        const bool is_beam = beam.limit > 0.0;
        if (is_beam) {
            node.reached = std::max(node.reached, (end.s - frame.margins.shift) * trace::kSooner);
            node.hint = end.hint;
        }
        const bool misses = is_beam && end.misses;
        const WindowChain* chain =
            frame.chain < 0 ? nullptr : &out_.windows.chains[static_cast<std::size_t>(frame.chain)];
        if (level > 0 && !misses && !(chain != nullptr && chain->hits)) return true;
        const bool has_windows = chain != nullptr && chain->length > 0;
        out_.cells.push_back({node.first, node.last, misses, node.reached, node.hint,
                              has_windows ? static_cast<std::int32_t>(chain->first) : -1});
        return false;
    }

  private:
    const ScreenBeams& beams_;
    BeamedSamples& out_;
    trace::TraceCounters& window_counters_;
};

void ScreenBeams::trace(std::span<const double> u, std::span<const double> v, std::span<const double> t,
                        BeamedSamples& out, trace::TraceCounters& counters,
                        trace::TraceCounters& window_counters) const {
    out.samples.codes.resize(u.size());
    hierarchy_.codes(u, v, t, out.samples.codes);
    out.samples.sort();
    out.cells.clear();
    out.windows.windows.clear();
    Descent descent(*this, out, window_counters);
    descend(descent, 0.0, tracer_, out.tree, counters);
    // Mostly all are of the finest level, and in order.
    if (!std::ranges::is_sorted(out.cells, {}, &BeamedCell::first))
        std::ranges::sort(out.cells, {}, &BeamedCell::first);
}

}  // namespace strata::accel
