// Settings of pictures that stand side by side: "none; N=2; N=10 m=4 camera.fov_deg=40".
//
// Entries are separated by ';', the settings of an entry by blanks. A setting is KEY=VALUE: the key of a scene file
// (`sampling.N`), or its last part where that names one key (`fov_deg`) or is one of the sampling's (`N`, `m`, `l` or
// `time_order`, `estimator`, `seed`). A name of an estimator alone is that estimator: `none`, `sobol N=4`. Values are
// TOML, words without quotes; ';' and blanks within quotes, [] and {} belong to the value. label="..." is what is
// written at the picture. The word `scene` changes nothing: alone it is the scene as it is.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "src/scene/scene.h"

namespace strata::tools::job {

struct ColumnSettings {
    std::string text;                      // as typed, without blanks around it
    std::string label;                     // as given, or made from the settings; never empty
    std::vector<std::string> assignments;  // "sampling.N=2", as scene::apply_override takes them
};

// All entries, one at least. origin is what the text was given to ("--columns"), for messages. Throws UsageError for
// an empty entry, a setting without '=', an unknown key or estimator, brackets or quotes that do not close. Values are
// checked when they are applied.
std::vector<ColumnSettings> parse_columns(std::string_view origin, std::string_view text);

// One entry; a ';' in it is an error.
ColumnSettings parse_column(std::string_view origin, std::string_view text);

// The pieces between separators that stand outside quotes and brackets, without blanks around them, empty ones too:
// "1, [2,3]" at ","s. Throws UsageError for brackets or quotes that do not close.
std::vector<std::string_view> split_values(std::string_view origin, std::string_view text, std::string_view separators);

// `m` -> `sampling.m`, `fov_deg` -> `camera.fov_deg`, `surface.gain` as it is. Throws UsageError, with the nearest
// name, for what is no key of a scene file or a last part that several sections have. `relief.TERM.key` is passed on:
// which terms there are, is known when it is applied.
std::string full_key_name(std::string_view origin, std::string_view name);

// The scene with the entry's settings, validated. Throws scene::SceneError, beginning with origin and the entry's text.
scene::Scene with_settings(const scene::Scene& scene, const ColumnSettings& column, std::string_view origin);

}  // namespace strata::tools::job
