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

// The cells of a level in every node, with their beams; where there is no beam the parent's end is handed on.
void ScreenBeams::split(int level, BeamedSamples& out) const {
    const int shift = hierarchy_.shift(level);
    const std::vector<std::uint64_t>& codes = out.samples.codes;
    out.children.clear();
    out.margins.clear();
    out.beams.clear();
    for (const BeamedSamples::Node& node : out.nodes) {
        for (std::uint32_t i = node.first; i < node.last;) {
            const std::uint64_t code = codes[i] >> shift;
            std::uint32_t end = i + 1;
            while (end < node.last && codes[end] >> shift == code) ++end;
            std::optional<CellBeam> cell = around_.around(hierarchy_.cell(code, level));
            if (!cell) cell.emplace();  // with a limit of 0: left at once
            trace::Beam& beam = out.beams.emplace_back(cell->beam);
            beam.start = std::max(beam.start, node.reached * cell->margins.cosine * trace::kSooner);
            beam.hint = node.hint;
            out.margins.push_back(cell->margins);
            out.children.push_back({i, end, node.reached, node.hint});
            i = end;
        }
    }
}

// Nodes that go on to the next level; the others are done.
void ScreenBeams::keep(int level, BeamedSamples& out) const {
    out.nodes.clear();
    for (std::size_t i = 0; i < out.children.size(); ++i) {
        BeamedSamples::Node& node = out.children[i];
        bool misses = false;
        if (out.beams[i].limit > 0.0) {
            const trace::BeamEnd& end = out.ends[i];
            node.reached = std::max(node.reached, (end.s - out.margins[i].shift) * trace::kSooner);
            node.hint = end.hint;
            misses = end.misses;
        }
        if (level > 0 && !misses) {
            out.nodes.push_back(node);
        } else {
            BeamedCell cell{node.first, node.last, misses, node.reached, node.hint};
            if (!misses && out.beams[i].limit > 0.0) {
                cell.leaf = static_cast<std::int32_t>(out.leaves.size());
                out.leaves.push_back({{out.beams[i], out.margins[i]}, out.ends[i].s, out.ends[i].slope});
            }
            out.cells.push_back(cell);
        }
    }
}

void ScreenBeams::trace(std::span<const double> u, std::span<const double> v, std::span<const double> t,
                        BeamedSamples& out, trace::TraceCounters& counters) const {
    out.samples.sort(hierarchy_, u, v, t);
    out.cells.clear();
    out.leaves.clear();
    out.nodes.assign(1, {0, static_cast<std::uint32_t>(u.size()), 0.0, 0.0f});
    for (int level = hierarchy_.levels() - 1; level >= 0; --level) {
        split(level, out);
        out.ends.resize(out.beams.size());
        tracer_.trace(out.beams, out.ends, counters);
        keep(level, out);
    }
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
