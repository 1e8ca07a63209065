#include "tools/sweep/ledger.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "tools/job/settings_mark.h"

namespace strata::tools::sweep {

std::string fingerprint(const image::Metadata& metadata) { return job::mark_of(image::pack(metadata)); }

PictureCost cost_of(const render::RenderResult& result, const image::Metadata& metadata) {
    return {.fingerprint = fingerprint(metadata),
            .rays = result.counters.rays,
            .shadow_rays = result.counters.shadow_rays,
            .noise_evaluations = result.counters.noise_evaluations,
            .seconds = result.seconds,
            .cpu_seconds = result.cpu_seconds,
            .threads = result.threads};
}

std::optional<Ledger> read_ledger(const std::filesystem::path& json_file) {
    Ledger ledger;
    std::error_code error;
    if (!std::filesystem::exists(json_file, error)) return ledger;
    std::ifstream file(json_file);
    const auto json = nlohmann::json::parse(file, nullptr, /*allow_exceptions=*/false);
    if (!json.is_object() || !json.contains("costs") || !json["costs"].is_object()) return std::nullopt;
    for (const auto& [name, cost] : json["costs"].items()) {
        try {
            ledger[name] = {.fingerprint = cost.at("fingerprint").get<std::string>(),
                            .rays = cost.at("rays").get<std::uint64_t>(),
                            .shadow_rays = cost.at("shadow_rays").get<std::uint64_t>(),
                            .noise_evaluations = cost.at("noise_evaluations").get<std::uint64_t>(),
                            .seconds = cost.at("seconds").get<double>(),
                            .cpu_seconds = cost.at("cpu_seconds").get<double>(),
                            .threads = cost.at("threads").get<int>()};
        } catch (const nlohmann::json::exception&) {
            ledger.erase(name);
        }
    }
    return ledger;
}

nlohmann::ordered_json to_json(const Ledger& ledger) {
    auto json = nlohmann::ordered_json::object();
    for (const auto& [file, cost] : ledger) {
        json[file] = {{"fingerprint", cost.fingerprint}, {"rays", cost.rays},
                      {"shadow_rays", cost.shadow_rays}, {"noise_evaluations", cost.noise_evaluations},
                      {"seconds", cost.seconds},         {"cpu_seconds", cost.cpu_seconds},
                      {"threads", cost.threads}};
    }
    return json;
}

std::optional<PictureCost> find_cost(const Ledger& ledger, const std::string& file, const image::Metadata& metadata) {
    const auto found = ledger.find(file);
    if (found == ledger.end() || found->second.fingerprint != fingerprint(metadata)) return std::nullopt;
    return found->second;
}

}  // namespace strata::tools::sweep
