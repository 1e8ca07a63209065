#include "tools/job/picture_labels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "src/scene/key_text.h"
#include "src/scene/keys.h"

namespace strata::tools::job {

namespace {

using Values = std::vector<std::pair<std::string, std::string>>;  // of every key, in the order of describe()

constexpr std::array<std::string_view, 3> kAlways{"sampling.estimator", "sampling.N", "sampling.m"};

Values values_of(scene::Scene scene) {
    Values values;
    for (const scene::Section& section : scene::describe(scene)) {
        for (const scene::Key& key : section.keys) {
            // Without antialiasing neither N nor m has a part in the picture.
            const bool matters =
                key.matters && !(scene::row_of(scene.sampling.estimator).is_single && section.name == "sampling" &&
                                 key.name != "estimator" && key.name != "tolerance");
            values.emplace_back(key.full_name(), matters ? scene::value_text(key) : "");
        }
    }
    return values;
}

bool is_no_antialiasing(const Values::value_type& setting) {
    return setting.first == "sampling.estimator" && setting.second == "\"none\"";
}

std::string setting_text(const std::string& full_name, std::string value) {
    if (value.size() >= 2 && value.front() == '"') value = value.substr(1, value.size() - 2);
    if (full_name == "sampling.estimator") return value == "none" ? "no antialiasing" : value;
    if (full_name == "sampling.time_order") return "l = " + value;
    return fmt::format("{} = {}", full_name.substr(full_name.rfind('.') + 1), value);
}

}  // namespace

std::vector<std::string> labels_of(const std::vector<std::optional<scene::Scene>>& scenes,
                                   const std::vector<std::string>& names) {
    std::vector<Values> all(scenes.size());
    for (std::size_t i = 0; i < scenes.size(); ++i)
        if (scenes[i]) all[i] = values_of(*scenes[i]);
    // Among the pictures in which the key matters; none has no estimator to tell apart.
    const auto differs = [&](std::size_t key) {
        std::set<std::string> values;
        for (const Values& v : all)
            if (!v.empty() && !v[key].second.empty() && !is_no_antialiasing(v[key])) values.insert(v[key].second);
        return values.size() > 1;
    };

    std::vector<std::string> labels;
    std::map<std::string, int> uses;
    for (const Values& values : all) {
        std::vector<std::string> parts, always;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto& [key, value] = values[i];
            if (value.empty() || key == "title") continue;
            if (is_no_antialiasing(values[i]) || differs(i)) parts.push_back(setting_text(key, value));
            if (std::ranges::find(kAlways, key) != kAlways.end()) always.push_back(setting_text(key, value));
        }
        labels.push_back(fmt::format("{}", fmt::join(parts.empty() ? always : parts, ", ")));
        ++uses[labels.back()];
    }
    for (std::size_t i = 0; i < labels.size(); ++i)
        if (labels[i].empty() || uses[labels[i]] > 1) labels[i] = names[i];
    return labels;
}

}  // namespace strata::tools::job
