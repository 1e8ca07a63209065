#include "tools/sweep/job.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <system_error>

#include "src/image/image_error.h"
#include "src/image/output_file.h"
#include "src/image/text.h"
#include "src/scene/key_text.h"
#include "src/scene/override.h"
#include "src/scene/printer.h"
#include "src/scene/validate.h"
#include "tools/cli/errors.h"
#include "tools/job/foreign_picture.h"
#include "tools/report/folder.h"

namespace strata::tools::sweep {

namespace {

namespace fs = std::filesystem;

// Cells of few samples are judged by a reference that has four times the samples of the best, twice.
constexpr int kReferenceFactor = 2;
constexpr int kLeastReferenceN = 8;

void apply(scene::Scene& scene, const Axis& axis, std::size_t value) {
    scene::apply_override(scene, fmt::format("{}={}", axis.key, axis.values[value]),
                          fmt::format("{} {}", axis.origin, scene::excerpt(axis.values[value])));
}

Picture make_picture(std::string file, const scene::Scene& scene, const film::Rect& window) {
    const job::PictureJob job{scene, window};
    return {job, std::move(file), job.metadata("float"), job.float_exr()};
}

film::Rect window_of(const Request& request, const scene::Film& film) {
    if (request.crop.empty()) return {0, 0, film.width, film.height};
    return cli::parse_crop("--crop", request.crop, film);
}

Cell make_cell(const Request& request, const Job& job, const scene::Scene& base, std::size_t row, std::size_t column) {
    Cell cell{.row = row, .column = column, .settings = {}, .picture = {}};
    scene::Scene scene = base;
    std::string file, origin;
    const auto set = [&](const std::optional<Axis>& axis, std::size_t value) {
        if (!axis) return;
        apply(scene, *axis, value);
        cell.settings.emplace_back(axis->key, axis->values[value]);
        file += fmt::format("{}{}", file.empty() ? "" : "_", file_part(*axis, value));
        origin += fmt::format("{}{} {}", origin.empty() ? "" : ", ", axis->origin, axis->values[value]);
    };
    set(job.axes.columns, column);
    set(job.axes.rows, row);
    scene::validate(scene, origin);
    cell.picture = make_picture(file + ".exr", scene, window_of(request, scene.film));
    return cell;
}

void make_cells(const Request& request, Job& job) {
    scene::Scene base = job.loaded.scene;
    for (const Axis& axis : job.axes.fixed) apply(base, axis, 0);
    for (std::size_t row = 0; row < job.rows(); ++row)
        for (std::size_t column = 0; column < job.columns(); ++column)
            job.cells.push_back(make_cell(request, job, base, row, column));
}

// The scene whose ideal picture the cell is to come close to: the same filter, the samples aside. The box of `super`
// is the B-spline of order 1.
scene::Scene target_of(const Cell& cell) {
    scene::Scene target = cell.picture.scene;
    if (scene::row_of(target.sampling.estimator).is_box()) target.sampling.m = 1;
    target.sampling.estimator = scene::EstimatorKind::shared_sobol;
    target.sampling.N = kMostN;
    target.film = target.film.without_colour();
    return target;
}

bool changes_target(const Axis& axis) {
    const bool only_colours = axis.key.starts_with("film.") && axis.key != "film.width" && axis.key != "film.height";
    return axis.key != "sampling.N" && axis.key != "sampling.estimator" && axis.key != "sampling.seed" && !only_colours;
}

// What tells a reference from others of the sweep: the axes that change the filter or the scene.
struct ReferenceName {
    std::string file = "reference", label;
};

ReferenceName name_reference(const Job& job, const Cell& cell) {
    ReferenceName name;
    if (scene::row_of(cell.picture.scene.sampling.estimator).is_box()) {
        name.file += "_box";
        name.label = "box";
    }
    const auto add = [&](const std::optional<Axis>& axis, std::size_t value) {
        if (!axis || !changes_target(*axis)) return;
        if (axis->key == "sampling.m" && !name.label.empty()) return;
        name.file += fmt::format("_{}", file_part(*axis, value));
        name.label += fmt::format("{}{}", name.label.empty() ? "" : ", ", value_label(*axis, value));
    };
    add(job.axes.columns, cell.column);
    add(job.axes.rows, cell.row);
    return name;
}

int reference_N(const Request& request, const Job& job) {
    if (request.reference_N) return *request.reference_N;
    int largest = 0;
    for (const Cell& cell : job.cells) largest = std::max(largest, cell.picture.scene.sampling.N);
    return std::clamp(kReferenceFactor * largest, kLeastReferenceN, kMostN);
}

// Seeds that no cell uses: a picture must not be judged by its own samples.
std::pair<std::uint64_t, std::uint64_t> unused_seeds(const Job& job) {
    std::set<std::uint64_t> used;
    for (const Cell& cell : job.cells) used.insert(cell.picture.scene.sampling.seed);
    std::uint64_t first = 1'000'001;
    while (used.contains(first)) ++first;
    std::uint64_t second = first + 1;
    while (used.contains(second)) ++second;
    return {first, second};
}

void make_references(const Request& request, Job& job) {
    const int N = reference_N(request, job);
    const auto [seed_a, seed_b] = unused_seeds(job);
    std::map<std::pair<std::string, std::string>, std::size_t> known;
    std::set<std::string> files;
    for (Cell& cell : job.cells) {
        scene::Scene target = target_of(cell);
        target.sampling.N = N;
        target.sampling.seed = seed_a;
        const film::Rect& w = cell.picture.window;
        const auto key = std::pair(scene::print_scene(target, scene::PrintedKeys::all),
                                   fmt::format("{},{},{},{}", w.x0, w.y0, w.x1, w.y1));
        const auto [place, is_new] = known.emplace(key, job.references.size());
        cell.reference = place->second;
        if (!is_new) continue;
        ReferenceName name = name_reference(job, cell);
        while (!files.insert(name.file).second) name.file += "_";
        Reference reference{.file = name.file + ".exr", .label = name.label, .halves = {}};
        reference.halves[0] = make_picture(name.file + "_a.exr", target, w);
        target.sampling.seed = seed_b;
        reference.halves[1] = make_picture(name.file + "_b.exr", target, w);
        job.references.push_back(std::move(reference));
    }
    if (job.references.size() == 1) job.references.front().label.clear();
}

void read_reference(const Request& request, Job& job) {
    job.given_reference = job::read_foreign_picture(request.reference, request.reference, request.quiet).linear;
    job.given_reference_name = fs::path(request.reference).filename().string();
    const image::Picture& reference = *job.given_reference;
    for (const Cell& cell : job.cells) {
        const film::Rect& w = cell.picture.window;
        if (w.width() != reference.width() || w.height() != reference.height())
            throw cli::UsageError(fmt::format(
                "--reference {}: it has {}x{} pixels, {} is to have {}x{}; allowed: equal sizes", request.reference,
                reference.width(), reference.height(), cell.picture.file, w.width(), w.height()));
    }
}

void make_folder(const Job& job) {
    report::make_folder(job.folder);
    for (const char* file : {kSheetFile, kCsvFile, kJsonFile}) image::check_replaceable(job.folder / file);
    for (const Cell& cell : job.cells) image::check_writable(job.folder / cell.picture.file);
    for (const Reference& reference : job.references) {
        image::check_writable(job.folder / reference.file);
        for (const Picture& half : reference.halves) image::check_writable(job.folder / half.file);
    }
}

}  // namespace

Job prepare_sweep(const Request& request) {
    Job job;
    job.quiet = request.quiet;
    job.threads = request.threads;
    job.axes = parse_axes(request.axes);
    job.loaded = request.scene.load();
    make_cells(request, job);
    if (request.reference == "auto")
        make_references(request, job);
    else if (request.reference != "none")
        read_reference(request, job);
    if (request.reference != "auto" && request.reference_N)
        throw cli::UsageError("--reference-N is for --reference auto");
    image::check_fonts();
    job.folder = request.output.empty() ? fs::path(job.loaded.name + "-sweep") : fs::path(request.output);
    make_folder(job);
    return job;
}

}  // namespace strata::tools::sweep
