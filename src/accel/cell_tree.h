// One descent through a hierarchy of cells, for the screen's (screen_beams.h) and the sun's (sun_beams.h): a beam
// around each cell that holds rays, begun where the beam of the cell around it ended, and on to the cells within it
// where that leaves something to do.
//
// Every ray has a code, from the top: the coarsest cell, then for each finer level the cell within that of the level
// above. Once the codes are sorted, the rays of a cell lie side by side.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <vector>

#include "src/trace/beam_tracer.h"

namespace strata::accel {

// A level's squares are 2^kLevelBits times narrower than those of the level above.
inline constexpr int kLevelBits = 2;

// Codes in ascending order, and whose they are; those of equal code keep their order.
struct SortedCodes {
    std::vector<std::uint64_t> codes;
    std::vector<std::uint32_t> order;  // codes[i] is that of ray order[i]

    // Sorts what stands in `codes`, where ray i has codes[i].
    void sort();

  private:
    // Codes counted from the least, and whose they are.
    template <class Code>
    struct Keys {
        struct Key {
            Code code;
            std::uint32_t ray;
        };
        std::vector<Key> keys, scratch;

        void sort(int bits);
    };

    template <class Code>
    void sort_by(Keys<Code>& sorted, std::uint64_t least, int bits);

    Keys<std::uint32_t> near_;  // for rays close together
    Keys<std::uint64_t> scattered_;
};

// A cell that holds rays, on the way down.
struct CellNode {
    std::uint32_t first, last;  // its rays have the sorted codes [first, last)
    double reached;             // up to where they are free of the surface, in the cells' own measure
    float hint;                 // step length to go on with
};

// The cells of a level that are at work. The memory is reused from descent to descent.
template <class Frame>
struct CellTree {
    std::vector<CellNode> nodes, children;
    std::vector<trace::Beam> beams;  // of the children, as are the following
    std::vector<Frame> frames;
    std::vector<trace::BeamEnd> ends;
};

// What makes one hierarchy differ from another. A Frame is what its cells must remember of a beam's place to read the
// beam's end.
template <class Cells>
concept CellFamily = requires(Cells& cells, int level, std::uint32_t index, std::uint64_t code, const CellNode& parent,
                              CellNode& node, typename Cells::Frame& frame, const trace::Beam& beam,
                              const trace::BeamEnd& end) {
    { cells.levels() } -> std::same_as<int>;  // level 0 is the finest
    { cells.codes() } -> std::convertible_to<std::span<const std::uint64_t>>;

    // Rays are in the same cell of a level where their codes are equal after this shift.
    { cells.shift(level) } -> std::same_as<int>;

    // Whether the cell of the rays [index, index) has something to do at this level or below.
    { cells.is_wanted(level, index, index) } -> std::same_as<bool>;

    // The beam around the cell of a shifted code, which begins no later than where the parent's ended.
    { cells.place(level, code, parent, frame) } -> std::same_as<trace::Beam>;

    // Notes in the node, and for its rays, where the beam ended. Whether to go on within the cell; not asked for at
    // the finest level.
    { cells.note(level, node, frame, beam, end) } -> std::same_as<bool>;
};

template <CellFamily Cells>
void split(Cells& cells, int level, CellTree<typename Cells::Frame>& tree) {
    const int shift = cells.shift(level);
    const std::span<const std::uint64_t> codes = cells.codes();
    tree.children.clear();
    tree.frames.clear();
    tree.beams.clear();
    for (const CellNode& node : tree.nodes) {
        for (std::uint32_t i = node.first, end; i < node.last; i = end) {
            const std::uint64_t code = codes[i] >> shift;
            for (end = i + 1; end < node.last && codes[end] >> shift == code;) ++end;
            if (!cells.is_wanted(level, i, end)) continue;
            trace::Beam& beam = tree.beams.emplace_back(cells.place(level, code, node, tree.frames.emplace_back()));
            beam.hint = node.hint;
            tree.children.push_back({i, end, node.reached, node.hint});
        }
    }
}

template <CellFamily Cells>
void keep(Cells& cells, int level, CellTree<typename Cells::Frame>& tree) {
    tree.nodes.clear();
    for (std::size_t i = 0; i < tree.children.size(); ++i) {
        CellNode& node = tree.children[i];
        if (cells.note(level, node, tree.frames[i], tree.beams[i], tree.ends[i]) && level > 0)
            tree.nodes.push_back(node);
    }
}

// From the coarsest level to the finest. reached: how far all rays are free to begin with.
template <CellFamily Cells>
void descend(Cells& cells, double reached, const trace::BeamTracer& tracer, CellTree<typename Cells::Frame>& tree,
             trace::TraceCounters& counters) {
    tree.nodes.assign(1, {0, static_cast<std::uint32_t>(cells.codes().size()), reached, 0.0f});
    for (int level = cells.levels() - 1; level >= 0 && !tree.nodes.empty(); --level) {
        split(cells, level, tree);
        tree.ends.resize(tree.beams.size());
        tracer.trace(tree.beams, tree.ends, counters);
        keep(cells, level, tree);
    }
}

}  // namespace strata::accel
