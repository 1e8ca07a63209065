#include "tools/converge/report.h"

#include "tools/report/folder.h"

namespace strata::tools::converge {

const char* limit_name(Limit limit) {
    if (limit == Limit::none) return "";
    return limit == Limit::reference ? "reference" : "rounding";
}

std::vector<std::filesystem::path> report_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const char* name : {"converge.csv", "converge.json", "summary.md", "error-samples.png", "error-samples.svg",
                             "error-time.png", "error-time.svg"}) {
        files.push_back(folder / name);
    }
    return files;
}

void write_report(const Report& report, const std::filesystem::path& folder, cli::PlannedFiles& files) {
    // Numbers first: a plot that fails costs none.
    files.write(folder / "converge.csv", converge_csv(report));
    files.write(folder / "converge.json", converge_json(report));
    files.write(folder / "summary.md", converge_summary(report));
    report::write_plots(converge_plot(report, PlotAgainst::samples), folder, "error-samples", files);
    report::write_plots(converge_plot(report, PlotAgainst::seconds), folder, "error-time", files);
}

}  // namespace strata::tools::converge
