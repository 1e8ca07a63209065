// All that a run found out.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tools/bench/measurement.h"
#include "tools/bench/plan.h"

namespace strata::tools::bench {

// Another renderer at the same scene, or near to it.
struct PeerResult {
    std::string id;  // "povray guaranteed", "embree rtcIntersect1"
    std::string what;
    std::vector<double> ns_a_ray;                         // one a round
    std::vector<std::pair<std::string, double>> facts{};  // by name, with the unit: "height error rms"
};

// A whole render in a process of its own.
struct MemoryResult {
    std::string id;
    int width = 0, height = 0;
    std::uint64_t peak_bytes = 0;  // resident set; 0: it failed
    double seconds = 0;
    std::string failure{};  // the program's words
};

struct Results {
    Plan plan;
    int rounds = 0;
    std::vector<Measurement> measurements{};
    std::vector<PeerResult> peers{};
    std::vector<std::string> missing_peers{};  // what is not installed, and how to install it
    std::vector<MemoryResult> memory{};
};

const PeerResult* find_peer(const Results& results, const std::string& id);

// Ids of the peers and of the memory rows that figures are taken from.
inline constexpr const char* kPovrayGuaranteed = "povray guaranteed";
inline constexpr const char* kPovrayLoose = "povray loose";
inline constexpr const char* kPovrayShadows = "povray guaranteed, shadows";
inline constexpr const char* kEmbreeOne = "embree rtcIntersect1";
inline constexpr const char* kEmbreeSixteen = "embree rtcIntersect16";
inline constexpr const char* kMemoryUsual = "1920x1080";
inline constexpr const char* kMemoryHuge = "16384x16384";

}  // namespace strata::tools::bench
