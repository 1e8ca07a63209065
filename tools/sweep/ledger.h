// What each picture of a sweep cost, kept in the sweep's folder from run to run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "src/image/metadata.h"
#include "src/render/render.h"

namespace strata::tools::sweep {

struct PictureCost {
    std::string fingerprint;  // of the metadata of the picture that it is the cost of
    std::uint64_t rays = 0, shadow_rays = 0, noise_evaluations = 0;
    double seconds = 0, cpu_seconds = 0;
    int threads = 0;
};

// Of all entries (settings_mark.h).
std::string fingerprint(const image::Metadata& metadata);

PictureCost cost_of(const render::RenderResult& result, const image::Metadata& metadata);

// By file name.
using Ledger = std::map<std::string, PictureCost>;

// From a sweep.json; empty when there is none, nothing when it cannot be understood.
std::optional<Ledger> read_ledger(const std::filesystem::path& json_file);

// The object of "costs" in a sweep.json.
nlohmann::ordered_json to_json(const Ledger& ledger);

// The cost of this very picture, if it is known.
std::optional<PictureCost> find_cost(const Ledger& ledger, const std::string& file, const image::Metadata& metadata);

}  // namespace strata::tools::sweep
