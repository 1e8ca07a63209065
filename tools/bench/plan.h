// What a run measures: sections, each a list of cases, that share cases where they can.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/bench/case.h"

namespace strata::tools::bench {

enum class Section {
    figures,
    scenes,
    rows,
    octaves,
    samples,
    resolution,
    threads,
    reference,
    light,
    subset,
    peers,
    memory
};

struct SectionName {
    Section section;
    const char* name;
    const char* meaning;
    bool by_default;
};
const std::vector<SectionName>& section_names();

// Names of sections with commas between. Throws UsageError for an unknown, an empty or a doubled one.
std::vector<Section> parse_sections(const std::string& text);

struct PlanSettings {
    std::vector<Section> sections;
    bool quick = false;  // small frames, few rays
    bool whole = false;  // whole frames whatever their rays
    std::optional<std::int64_t> rays;
};

// A point of a curve, of one case.
struct CurvePoint {
    double x = 0;
    std::string id;
};

// Cost against something: the name of its axis, and a line for each size or tracer.
struct Curve {
    Section section;
    std::string axis, name;
    std::vector<CurvePoint> points;
};

// The cases that the rows of the target table are taken from; empty where a section was left out.
struct FigureCases {
    std::string main;          // hyperterrain at the table's size and N
    std::string few_samples;   // N = 2
    std::string peer_samples;  // N = 4: 16 samples a pixel, as the peers
    std::string shadows, octaves, planar, reference;
    std::string one_thread, two_threads;
    std::string spin_still, spin_moving, camera_still, camera_moving;
};

// A scene at N = 2 in the blocks of larger N, and whole.
struct SubsetPair {
    std::string part, whole;
};

// A scene without and with one part of its light, by the cases' ids.
struct FeaturePair {
    std::string name, off, on;
};

struct Plan {
    PlanSettings settings;
    std::vector<Case> cases;
    std::vector<Curve> curves;
    FigureCases figures;
    std::vector<SubsetPair> subset_pairs;
    std::vector<FeaturePair> light;

    bool has(Section section) const;
};

Plan make_plan(const PlanSettings& settings);

}  // namespace strata::tools::bench
