#include "tools/render/layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "src/image/file_paths.h"
#include "src/image/format.h"
#include "src/image/output_file.h"
#include "src/image/stream_target.h"
#include "src/image/text.h"
#include "src/scene/key_text.h"
#include "tools/cli/errors.h"

namespace strata::tools::render {

namespace {

namespace fs = std::filesystem;

std::string given_or(const std::string& given, const std::optional<std::string>& recorded, const char* otherwise) {
    return !given.empty() ? given : recorded.value_or(otherwise);
}

void check_layer_prefix(const std::string& prefix) {
    const auto is_allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
    if (std::ranges::all_of(prefix, is_allowed)) return;
    throw cli::UsageError(fmt::format("--layer-prefix {}: allowed: letters, digits, _ and -", scene::excerpt(prefix)));
}

// A file of three channels does not hold what any number of layers cover.
void refuse_grounds(const integrate::ChannelSet& aovs) {
    for (const integrate::ChannelSet::Entry& aov : aovs.entries()) {
        if (!integrate::is_of_ground(aov.channel->type)) continue;
        throw cli::UsageError(fmt::format("--aov {}: allowed with --layers one", aov.channel->name));
    }
}

}  // namespace

std::vector<const integrate::Channel*> drawn_aovs(const Job& job) {
    std::vector<const integrate::Channel*> drawn;
    for (const integrate::ChannelSet::Entry& aov : job.aovs.entries()) {
        if (job::is_drawn(*aov.channel)) drawn.push_back(aov.channel);
    }
    return drawn;
}

void choose_aovs(const RenderRequest& request, Job& job) {
    job.aovs = job::aovs_of(request.aov, job.loaded, job.goal.passes);
    job.layers = given_or(request.layers, job.loaded.layers, "one");
    job.layer_prefix = given_or(request.layer_prefix, job.loaded.layer_prefix, "");
    check_layer_prefix(job.layer_prefix);
    if (job.layers != "one" && job.layers != "separate") {
        throw cli::UsageError(fmt::format("--layers {}: allowed: one, separate", scene::excerpt(job.layers)));
    }
    if (!drawn_aovs(job).empty()) image::check_fonts();
    if (job.layers != "one") return refuse_grounds(job.aovs);
    job.write.exr_extra = job::aov_channels(job.aovs, job.layer_prefix);
    job.write.exr_attributes = job::aov_header(job.aovs, job.layer_prefix);
}

// What is not drawn goes into an EXR.
void choose_layer_files(Job& job) {
    const auto is_exr = [](const fs::path& path) { return image::format_of(path) == image::Format::exr; };
    if (job.aovs.entries().size() > drawn_aovs(job).size() && std::ranges::none_of(job.outputs, is_exr)) {
        throw cli::UsageError(
            fmt::format("--aov {}: allowed with an EXR among the outputs: -o NAME.exr", job::names_of(job.aovs)));
    }
    if (job.layers == "one") return;
    if (job.shard) throw cli::UsageError("--layers separate: not with --shard; allowed: one");
    if (std::ranges::any_of(job.outputs, [](const fs::path& path) { return image::stream_target(path).has_value(); })) {
        throw cli::UsageError("--layers separate: allowed with outputs that are files");
    }
    job.layer_files = layer_files(job.outputs, job.aovs);
    for (const LayerFile& file : job.layer_files) image::check_writable(file.path);
}

void set_aovs(const Job& job, image::Metadata& metadata) {
    metadata.set("strata:aov", job::names_of(job.aovs));
    for (const integrate::ChannelSet::Entry& aov : job.aovs.entries()) {
        metadata.set(fmt::format("strata:aov:{}", aov.channel->name), job::description_of(*aov.channel));
    }
    if (job.layers != "one") metadata.set("strata:layers", job.layers);
    if (!job.layer_prefix.empty()) metadata.set("strata:layer_prefix", job.layer_prefix);
}

}  // namespace strata::tools::render
