#include "tools/job/ledger.h"

#include <fmt/format.h>

#include <fstream>

#include "tools/cli/standard_output.h"
#include "tools/job/settings_mark.h"

namespace strata::tools::job {

namespace {

integrate::Counters counters_from(const nlohmann::json& cost) {
    integrate::Counters counters;
    for (const auto& [name, member] : integrate::kCounters) counters.*member = cost.at(name).get<std::uint64_t>();
    return counters;
}

}  // namespace

std::string fingerprint(const image::Metadata& metadata) { return mark_of(image::pack(metadata)); }

PictureCost cost_of(const render::RenderResult& result, const image::Metadata& metadata) {
    return {.fingerprint = fingerprint(metadata),
            .counters = result.counters,
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
                            .counters = counters_from(cost),
                            .seconds = cost.at("seconds").get<double>(),
                            .cpu_seconds = cost.at("cpu_seconds").get<double>(),
                            .threads = cost.at("threads").get<int>()};
        } catch (const nlohmann::json::exception&) {
            ledger.erase(name);
        }
    }
    return ledger;
}

Ledger ledger_of(const std::filesystem::path& json_file, bool quiet) {
    const std::optional<Ledger> ledger = read_ledger(json_file);
    if (!ledger && !quiet) {
        cli::print_out(fmt::format("damaged  {}: it cannot be read; the times of pictures that are kept are lost\n",
                                   json_file.string()));
    }
    return ledger.value_or(Ledger{});
}

report::Json cost_json(const PictureCost& cost) {
    report::Json json = report::counts_json(cost.counters);
    json.update({{"seconds", cost.seconds}, {"cpu_seconds", cost.cpu_seconds}, {"threads", cost.threads}});
    return json;
}

report::Json to_json(const Ledger& ledger) {
    auto json = report::Json::object();
    for (const auto& [file, cost] : ledger) {
        json[file] = {{"fingerprint", cost.fingerprint}};
        json[file].update(cost_json(cost));
    }
    return json;
}

std::optional<PictureCost> find_cost(const Ledger& ledger, const std::string& file, const image::Metadata& metadata) {
    const auto found = ledger.find(file);
    if (found == ledger.end() || found->second.fingerprint != fingerprint(metadata)) return std::nullopt;
    return found->second;
}

}  // namespace strata::tools::job
