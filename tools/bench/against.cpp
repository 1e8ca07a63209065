#include "tools/bench/against.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/cli/errors.h"
#include "tools/cli/text_file.h"

namespace strata::tools::bench {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
    throw cli::UsageError(fmt::format("--against {}: {}", file.string(), why));
}

nlohmann::json parse(const std::filesystem::path& file) {
    std::string why;
    const auto text = cli::read_text_file(file, why);
    if (!text) refuse(file, fmt::format("cannot be read: {}; allowed: a bench.json of strata bench", why));
    nlohmann::json json = nlohmann::json::parse(*text, nullptr, false);
    if (json.is_discarded()) refuse(file, "is no JSON; allowed: a bench.json of strata bench");
    if (!json.is_object() || json.value("kind", nlohmann::json()) != "strata bench") {
        refuse(file, "is no benchmark; allowed: a bench.json of strata bench");
    }
    const nlohmann::json format = json.value("format", nlohmann::json());
    if (format != kFormat) {
        refuse(file, fmt::format("is of format {}, this program compares format {} alone", format.dump(), kFormat));
    }
    return json;
}

double positive(const nlohmann::json& row, const char* key) {
    const double value = row.at(key).get<double>();
    if (!(value >= 0) || !std::isfinite(value)) throw std::out_of_range(fmt::format("{} is {}", key, value));
    return value;
}

EarlierCase case_of(const nlohmann::json& row) {
    return {row.at("id").get<std::string>(), row.at("mark").get<std::string>(), positive(row, "ns_per_ray"),
            positive(row, "ns_per_ray_median"), positive(row, "evaluations_per_ray")};
}

const EarlierCase* find_case(const EarlierRun& earlier, const std::string& id) {
    const auto found = std::ranges::find(earlier.cases, id, &EarlierCase::id);
    return found == earlier.cases.end() ? nullptr : &*found;
}

double ratio(double now, double then) { return then > 0 ? now / then : now > 0 ? HUGE_VAL : 1; }

bool is_reference(const std::string& id) { return id.ends_with(" reference"); }

}  // namespace

EarlierRun read_earlier(const std::filesystem::path& file) {
    const nlohmann::json json = parse(file);
    EarlierRun run;
    run.file = file;
    try {
        run.version = json.at("version").get<std::string>();
        run.processor = json.at("machine").at("processor").get<std::string>();
        run.simd_target = json.at("machine").at("simd_target").get<std::string>();
        for (const nlohmann::json& row : json.at("cases")) run.cases.push_back(case_of(row));
    } catch (const std::exception& error) {
        refuse(file, fmt::format("lacks what strata bench writes: {}", error.what()));
    }
    return run;
}

void check_comparable(const EarlierRun& earlier, const Plan& plan) {
    int common = 0;
    for (const Case& what : plan.cases) {
        const EarlierCase* then = find_case(earlier, what.id());
        if (then == nullptr) continue;
        if (then->mark != what.mark()) {
            refuse(earlier.file,
                   fmt::format("its '{}' is another scene or other pixels than this run's (made with --quick, --whole "
                               "or --rays, or by another version); allowed: a file of the same scenes and options",
                               what.id()));
        }
        ++common;
    }
    if (common == 0) refuse(earlier.file, "has no case of this run; allowed: a file of the same sections");
}

std::vector<Comparison> compare(const EarlierRun& earlier, const std::vector<Measurement>& now) {
    std::vector<Comparison> all;
    for (const Measurement& measurement : now) {
        const EarlierCase* then = find_case(earlier, measurement.what.id());
        if (then == nullptr || measurement.cpu_s.empty()) continue;
        all.push_back({then->id, ratio(measurement.ns_a_ray(Pick::least), then->ns_a_ray_least),
                       ratio(measurement.ns_a_ray(Pick::median), then->ns_a_ray_median),
                       ratio(measurement.evaluations_a_ray(), then->evaluations_a_ray)});
    }
    return all;
}

Overall overall(const std::vector<Comparison>& comparisons) {
    double sums[2] = {0, 0};
    int counts[2] = {0, 0};
    for (const Comparison& comparison : comparisons) {
        const int kind = is_reference(comparison.id) ? 1 : 0;
        sums[kind] += std::log(comparison.time_ratio);
        ++counts[kind];
    }
    const auto mean = [&](int kind) {
        return counts[kind] > 0 ? std::optional<double>(std::exp(sums[kind] / counts[kind])) : std::nullopt;
    };
    return {mean(0), mean(1)};
}

}  // namespace strata::tools::bench
