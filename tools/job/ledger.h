// What each picture of a folder cost, kept in the folder from run to run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "src/image/metadata.h"
#include "src/render/render.h"
#include "tools/report/json.h"

namespace strata::tools::job {

struct PictureCost {
    std::string fingerprint;       // of the metadata of the picture that it is the cost of
    integrate::Counters counters;  // those of kCounters alone
    double seconds = 0, cpu_seconds = 0;
    int threads = 0;
};

// Of all entries (settings_mark.h).
std::string fingerprint(const image::Metadata& metadata);

PictureCost cost_of(const render::RenderResult& result, const image::Metadata& metadata);

// By file name.
using Ledger = std::map<std::string, PictureCost>;

// From a JSON file that has them as "costs"; empty when there is none, nothing when it cannot be understood.
std::optional<Ledger> read_ledger(const std::filesystem::path& json_file);

// The same, but empty for what cannot be understood, as is told unless quiet.
Ledger ledger_of(const std::filesystem::path& json_file, bool quiet);

// The object of "costs".
report::Json to_json(const Ledger& ledger);

// Of one picture, without its fingerprint.
report::Json cost_json(const PictureCost& cost);

// The cost of this very picture, if it is known.
std::optional<PictureCost> find_cost(const Ledger& ledger, const std::string& file, const image::Metadata& metadata);

}  // namespace strata::tools::job
