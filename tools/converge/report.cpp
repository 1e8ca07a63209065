#include "tools/converge/report.h"

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

void write_report(const ConvergeReport& report, const std::filesystem::path& folder, cli::PlannedFiles& files) {
    // Numbers first: a plot that fails costs none.
    files.write(folder / "converge.csv", converge_csv(report));
    files.write(folder / "converge.json", converge_json(report));
    files.write(folder / "summary.md", converge_summary(report));
    const auto write = [&](const report::Plot& plot, const std::string& name) {
        // Without any error there is nothing to draw.
        if (plot.panels.empty()) return;
        for (const char* extension : {".png", ".svg"}) {
            const std::filesystem::path path = folder / (name + extension);
            files.write_made(path, [&] { return report::draw_plot(plot, path); });
        }
    };
    write(converge_plot(report, PlotAgainst::samples), "error-samples");
    write(converge_plot(report, PlotAgainst::seconds), "error-time");
}

}  // namespace strata::tools::converge
