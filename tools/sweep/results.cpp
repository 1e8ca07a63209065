#include "tools/sweep/results.h"

#include "src/image/encode.h"
#include "src/image/read.h"
#include "tools/sweep/tables.h"

namespace strata::tools::sweep {

namespace {

image::Picture read(const Job& job, const std::string& file) { return image::read_picture(job.folder / file); }

// Writes the mean, too.
image::Picture mean_of_halves(cli::PlannedFiles& files, const Job& job, const Reference& reference, double& error) {
    image::Picture mean = read(job, reference.halves[0].file);
    const image::Picture other = read(job, reference.halves[1].file);
    error = image::compare(mean, other).rmse / 2;
    for (std::size_t i = 0; i < mean.rgb.size(); ++i)
        mean.rgb[i] = static_cast<float>((static_cast<double>(mean.rgb[i]) + other.rgb[i]) / 2);

    // No scene entry: it cannot be rendered from one scene.
    image::Metadata metadata;
    metadata.set("strata:version", STRATA_VERSION);
    metadata.set("strata:mean_of", reference.halves[0].file + ", " + reference.halves[1].file);
    metadata.set("strata:reference_error", error);
    const std::filesystem::path path = job.folder / reference.file;
    write_if_changed(files, path, image::encode(path, mean, metadata, {.exr_format = image::ExrFormat::floating}));
    return mean;
}

}  // namespace

bool Results::is_near_reference(const Job& job, std::size_t cell) const {
    if (!cells[cell] || reference_errors.empty()) return false;
    return cells[cell]->rmse < kTrustFactor * reference_errors[job.cells[cell].reference];
}

Results evaluate_sweep(cli::PlannedFiles& files, const Job& job) {
    Results results;
    results.cells.resize(job.cells.size());
    const auto compare_cells = [&](const image::Picture& reference, std::size_t index) {
        for (std::size_t i = 0; i < job.cells.size(); ++i)
            if (job.cells[i].reference == index)
                results.cells[i] = image::compare(read(job, job.cells[i].picture.file), reference);
    };
    if (job.given_reference) compare_cells(*job.given_reference, 0);
    for (std::size_t r = 0; r < job.references.size(); ++r) {
        double error = 0;
        const image::Picture reference = mean_of_halves(files, job, job.references[r], error);
        results.reference_errors.push_back(error);
        compare_cells(reference, r);
    }
    return results;
}

}  // namespace strata::tools::sweep
