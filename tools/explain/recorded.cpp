#include "tools/explain/recorded.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tools/cli/errors.h"
#include "tools/cli/text_file.h"

namespace strata::tools::explain {

namespace {

using nlohmann::json;

json parse_file(const std::filesystem::path& path) {
    std::string why;
    const auto text = cli::read_text_file(path, why);
    if (!text) throw cli::UsageError(fmt::format("--stats {}: cannot be read: {}", path.string(), why));
    json parsed = json::parse(*text, nullptr, false);
    if (!parsed.is_object()) {
        throw cli::UsageError(fmt::format("--stats {}: not JSON that strata render --stats wrote", path.string()));
    }
    return parsed;
}

class Reader {
  public:
    Reader(const std::filesystem::path& path, const json& object) : path_(path), object_(object) {}

    double number(const char* key) const {
        const auto found = object_.find(key);
        if (found == object_.end() || !found->is_number() || found->get<double>() < 0.0) missing(key);
        return found->get<double>();
    }

    std::string text(const char* key) const {
        const auto found = object_.find(key);
        if (found == object_.end() || !found->is_string()) missing(key);
        return found->get<std::string>();
    }

  private:
    [[noreturn]] void missing(const char* key) const {
        throw cli::UsageError(
            fmt::format("--stats {}: has no '{}'; allowed: a file that this version's strata render --stats wrote",
                        path_.string(), key));
    }

    const std::filesystem::path& path_;
    const json& object_;
};

}  // namespace

Recorded read_recorded(const std::filesystem::path& path, const std::string& mark, std::uint64_t rays) {
    const json parsed = parse_file(path);
    const Reader reader(path, parsed);
    if (reader.text("settings_mark") != mark) {
        throw cli::UsageError(
            fmt::format("--stats {}: of a render of another scene ('{}'), or with another setting, crop or tracer; "
                        "allowed: of the same render",
                        path.string(), reader.text("scene")));
    }
    const double counted = reader.number("rays");
    const double passes = counted / static_cast<double>(rays);
    if (!(passes >= 1.0) || passes != static_cast<double>(static_cast<std::uint64_t>(passes))) {
        throw cli::UsageError(
            fmt::format("--stats {}: of an interrupted render: {:.0f} of {} rays", path.string(), counted, rays));
    }
    Recorded recorded;
    recorded.passes = static_cast<std::uint64_t>(passes);
    recorded.threads = static_cast<int>(reader.number("threads"));
    recorded.simd_target = reader.text("simd_target");
    recorded.costs.rays = rays;
    const auto share = [&](const char* key) { return reader.number(key) / passes; };
    for (const auto& [name, count] : integrate::kCounters) recorded.costs.counts[count] = share(name);
    recorded.costs.seconds = share("seconds");
    recorded.costs.cpu_seconds = share("cpu_seconds");
    recorded.costs.peak_memory_bytes = reader.number("peak_memory_bytes");
    return recorded;
}

}  // namespace strata::tools::explain
