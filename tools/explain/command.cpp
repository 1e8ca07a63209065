// strata explain: what a render does, what it leaves out, and what it will cost.
#include <memory>
#include <optional>

#include "noise/simd_target.h"
#include "src/image/file_paths.h"
#include "src/parallel/cancel.h"
#include "src/render/progressive.h"
#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/scene_argument.h"
#include "tools/cli/shared_options.h"
#include "tools/cli/standard_output.h"
#include "tools/explain/explanation.h"
#include "tools/job/aov.h"
#include "tools/job/settings_mark.h"

namespace strata::tools::explain {

namespace {

struct ExplainRequest {
    cli::SceneArgument scene;
    std::string crop, json, statistics, aov;
    std::optional<integrate::Tracer> tracer;
    std::optional<int> passes;
    int threads = 0;
    bool is_simd_pinned = false, no_pilot = false, quiet = false;
};

void plan_json(const ExplainRequest& request, const cli::LoadedScene& loaded, cli::PlannedFiles& files) {
    if (request.json.empty()) return;
    for (const std::string& input : {loaded.source, request.statistics}) {
        if (!input.empty() && image::is_one_file(input, request.json)) {
            throw cli::UsageError("--json " + request.json +
                                  ": this is what is to be read; allowed: a file of its own");
        }
    }
    files.plan(request.json);
    cli::keep_output_for(request.json);
}

int explain_command(const ExplainRequest& request) {
    parallel::end_on_signals();
    cli::LoadedScene loaded = request.scene.load();
    if (!request.is_simd_pinned && loaded.simd_target) noise::pin_simd_target(*loaded.simd_target);
    Explanation explanation;
    explanation.window = cli::window_of(request.crop, loaded);
    const integrate::Tracer tracer = cli::tracer_of(request.tracer, loaded);
    explanation.tracer = cli::name_of(tracer);
    explanation.simd_target = noise::simd_target();
    explanation.name = loaded.name;
    explanation.scene = loaded.scene;
    int passes = request.passes ? *request.passes
                                : cli::parse_integer("--passes", loaded.passes.value_or("1"), 1, render::kMostPasses);
    cli::PlannedFiles files;
    plan_json(request, loaded, files);
    if (!request.statistics.empty()) {
        const std::string mark = job::settings_mark({loaded.scene, explanation.window, tracer});
        explanation.recorded = read_recorded(request.statistics, mark, count_rays(loaded.scene, explanation.window));
        if (!request.passes) passes = static_cast<int>(explanation.recorded->passes);
    }
    const integrate::ChannelSet aovs = job::aovs_of(request.aov, loaded, passes);
    explanation.plan = make_plan(loaded.scene, tracer, passes, aovs);
    explanation.prediction = predict(loaded.scene, explanation.window,
                                     {.tracer = tracer,
                                      .threads = request.threads,
                                      .passes = passes,
                                      .aovs = aovs,
                                      .with_pilot = !request.no_pilot});
    if (!request.json.empty()) files.write(request.json, explanation_json(explanation));
    if (!request.quiet) cli::print_out(explanation_text(explanation));
    return files.all_written() ? 0 : cli::kExitRuntime;
}

std::string count_names() {
    std::string names = "rays";
    for (const auto& [name, count] : integrate::kCounters) {
        if (is_predicted(count)) names += std::string(", ") + name;
    }
    return names;
}

}  // namespace

void add_command(cli::Command& program) {
    cli::Command* command =
        program.add_subcommand("explain", "Tell what a render does, what it leaves out, and what it will cost");
    auto request = std::make_shared<ExplainRequest>();
    request->scene.add_to(*command);
    cli::add_crop(*command, request->crop);
    cli::add_threads(*command, request->threads);
    cli::add_tracer(*command, request->tracer);
    cli::add_simd(*command, &request->is_simd_pinned);
    command->add_option("--passes", request->passes, 1, render::kMostPasses, "K",
                        "As for render: average so many passes; default 1");
    command->add_option("--aov", request->aov, "all|NAME,...", "As for render: also keep other channels");
    command->add_flag("--no-pilot", request->no_pilot, "Cast no rays: tell only what is known without");
    command->add_option(
        "--stats", request->statistics, "FILE.json",
        "What `strata render --stats` wrote of the same render: the actual costs beside the predicted ones");
    command->add_option("--json", request->json, "FILE.json", "Write the same as JSON; - for standard output");
    cli::add_quiet(*command, request->quiet, "No text");
    command->footer(
        "A pilot casts 1 % of the rays - at least 65536, or all of up to 131072; at most 262144, or 16384 of the "
        "reference tracer's - in\n"
        "small blocks all over the frame, on one thread. What the blocks differ by tells the interval that holds a\n"
        "count 99 times in 100. Counts are the same in every run; times are not;\n"
        "`seconds` supposes a core for every thread.\n"
        "Distances and wavelengths are in world units; a pixel is that at the frame's centre, mid-shutter. `below\n"
        "tolerance from`: farther away the octave raises or lowers the surface by less than a hit's tolerance.\n"
        "JSON: scene, version, width, height, crop [x0,y0,x1,y1], estimator, N, m, tracer, simd_target, threads;\n"
        "features [{name, needed, why}];\n"
        "octaves [{octave, amplitude, wavelength, pixel_wide_at, below_tolerance_from, roles [{from, to, role}]}] "
        "with\n"
        "role geometry (hits and normals), normal or nothing; below_tolerance_from is null for isosurfaces;\n"
        "relief [{name, type, of, octaves, low, high, slope, bend}], its terms with bounds in surface units;\n"
        "pilot {rays, share, cpu_seconds} or null; recorded {passes, threads, simd_target} or null, of --stats;\n"
        "costs {" +
        count_names() +
        ",\n"
        "cpu_seconds, seconds, peak_memory_bytes}, each {predicted, low, high, actual, ratio}, null where not known.\n"
        "low and high: of counts. Of several passes costs are those of one.\n"
        "Exit codes: 0 done, 1 failed on the way, 2 wrong command line, scene or --stats.");
    command->action([request] { return explain_command(*request); });
}

}  // namespace strata::tools::explain
