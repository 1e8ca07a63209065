#include "tools/converge/report.h"

#include <fstream>
#include <span>

#include "src/image/output_file.h"

namespace strata::tools {

namespace {

void write_text(const std::filesystem::path& path, const std::string& text) {
    image::replace_file(path, std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

}  // namespace

const char* tracer_name(integrate::Tracer tracer) { return tracer == integrate::Tracer::fast ? "fast" : "reference"; }

const char* limit_name(Limit limit) {
    if (limit == Limit::none) return "";
    return limit == Limit::reference ? "reference" : "rounding";
}

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with("model name")) continue;
        const std::size_t start = line.find_first_not_of(" \t", line.find(':') + 1);
        if (start != std::string::npos) return line.substr(start);
    }
    return "an unnamed processor";
}

std::vector<std::filesystem::path> report_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const char* name : {"converge.csv", "converge.json", "summary.md", "error-samples.png", "error-samples.svg",
                             "error-time.png", "error-time.svg"}) {
        files.push_back(folder / name);
    }
    return files;
}

void write_report(const ConvergeReport& report, const std::filesystem::path& folder) {
    // Numbers first: a plot that fails costs none.
    write_text(folder / "converge.csv", converge_csv(report));
    write_text(folder / "converge.json", converge_json(report));
    write_text(folder / "summary.md", converge_summary(report));
    const Plot samples = converge_plot(report, PlotAgainst::samples);
    const Plot seconds = converge_plot(report, PlotAgainst::seconds);
    for (const char* extension : {".png", ".svg"}) {
        // Without any error there is nothing to draw.
        if (!samples.panels.empty()) write_plot(samples, folder / ("error-samples" + std::string(extension)));
        if (!seconds.panels.empty()) write_plot(seconds, folder / ("error-time" + std::string(extension)));
    }
}

}  // namespace strata::tools
