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

// Of beams after each touch, but for the finest, whose rays do as well. Speed only.
constexpr int kMostJumps = 24;

scene::TimeSpan shutter(const scene::Scene& scene) { return scene::open_shutter(scene); }

double time_cells(double blur, double leaf) { return std::max(1.0, blur / (kBlurASide * leaf)); }

// The largest power of two of pixels with few enough rays, with the scene's motion divided to suit.
double leaf_side(const scene::Scene& scene, double blur) {
    const double rays = scene.sampling.samples_a_pixel();
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

// The cells within each node, with its zones.
void ScreenBeams::split(int level, BeamedSamples& out) const {
    const int shift = hierarchy_.shift(level);
    const std::span<const std::uint64_t> codes = out.samples.codes;
    out.children.clear();
    out.bundles.clear();
    for (const ScreenNode& node : out.nodes) {
        for (std::uint32_t i = node.first, end; i < node.last; i = end) {
            const std::uint64_t code = codes[i] >> shift;
            for (end = i + 1; end < node.last && codes[end] >> shift == code;) ++end;
            // Where no beam fits around the cell, one with a limit of 0 stands for it.
            const CellBeam cell = around_.around(hierarchy_.cell(code, level)).value_or(CellBeam{});
            out.children.push_back({i, end, {}});
            out.bundles.push_back({cell, node.zones});
        }
    }
}

// Around the cells whose beams met something, from their first zone on.
void ScreenBeams::open_windows(int level, BeamedSamples& out, trace::TraceCounters& window_counters) const {
    out.windows.chains.clear();
    out.chains.assign(out.bundles.size(), -1);
    if (level > 0 && hierarchy_.side(level) > kWidestWithWindows) return;
    for (std::size_t i = 0; i < out.bundles.size(); ++i) {
        const ZonedBundle& bundle = out.bundles[i];
        if (!(bundle.cell.beam.limit > 0.0) || bundle.zones.count == 0) continue;
        const Zone& zone = bundle.zones.zones[0];
        out.chains[i] = static_cast<std::int32_t>(out.windows.chains.size());
        out.windows.chains.push_back({.cell = &bundle.cell, .s = zone.s, .slope = static_cast<double>(zone.slope)});
    }
    windows_.build(out.windows, window_counters);
}

// Cells of the finest level, those whose rays meet nothing, and those all of whose rays hit within their windows are
// done. The others are nodes of the next level.
void ScreenBeams::keep(int level, BeamedSamples& out) const {
    out.nodes.clear();
    for (std::size_t i = 0; i < out.children.size(); ++i) {
        ScreenNode& node = out.children[i];
        node.zones = out.bundles[i].zones;
        const WindowChain* chain =
            out.chains[i] < 0 ? nullptr : &out.windows.chains[static_cast<std::size_t>(out.chains[i])];
        if (level > 0 && node.zones.count > 0 && !(chain != nullptr && chain->hits)) {
            out.nodes.push_back(node);
            continue;
        }
        const auto first_zone = static_cast<std::uint32_t>(out.zones.size());
        out.zones.insert(out.zones.end(), node.zones.all().begin(), node.zones.all().end());
        const bool has_windows = chain != nullptr && chain->length > 0;
        out.cells.push_back({node.first, node.last, first_zone, static_cast<std::uint32_t>(out.zones.size()),
                             has_windows ? static_cast<std::int32_t>(chain->first) : -1});
    }
}

void ScreenBeams::trace(std::span<const double> u, std::span<const double> v, std::span<const double> t,
                        BeamedSamples& out, trace::TraceCounters& counters,
                        trace::TraceCounters& window_counters) const {
    out.samples.codes.resize(u.size());
    hierarchy_.codes(u, v, t, out.samples.codes);
    out.samples.sort();
    out.cells.clear();
    out.zones.clear();
    out.windows.windows.clear();
    out.nodes.assign(1, {0, static_cast<std::uint32_t>(u.size()), {}});
    out.nodes.front().zones.put({});
    for (int level = hierarchy_.levels() - 1; level >= 0 && !out.nodes.empty(); --level) {
        split(level, out);
        out.zone_tracer.follow(tracer_, out.bundles, level > 0 ? kMostJumps : 0, counters);
        open_windows(level, out, window_counters);
        keep(level, out);
    }
    // Mostly all are of the finest level, and in order.
    if (!std::ranges::is_sorted(out.cells, {}, &BeamedCell::first))
        std::ranges::sort(out.cells, {}, &BeamedCell::first);
}

}  // namespace strata::accel
