// An experiment and its analysis as files: for spreadsheets, for programs, for eyes and for readers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/cli/planned_files.h"
#include "tools/converge/analysis.h"
#include "tools/report/plot.h"

namespace strata::tools::converge {

struct Report {
    std::string function;  // the scene's name
    const Experiment& experiment;
    const Analysis& analysis;
};

// A row a point, and a first line with the columns' names.
std::string converge_csv(const Report& report);

// The same rows, with slopes, times to errors, tests of bias, references and the machine.
std::string converge_json(const Report& report);

// A page of Markdown in plain words.
std::string converge_summary(const Report& report);

// Error against samples or time, a panel for each order and tracer: points, fitted lines, and dotted lines of the
// slopes that theory knows.
enum class PlotAgainst { samples, seconds };
report::Plot converge_plot(const Report& report, PlotAgainst against);

// The files that write_report() will put into a folder.
std::vector<std::filesystem::path> report_files(const std::filesystem::path& folder);

// Those, which are planned; each fails alone.
void write_report(const Report& report, const std::filesystem::path& folder, cli::PlannedFiles& files);

// "", "reference" or "rounding".
const char* limit_name(Limit limit);

}  // namespace strata::tools::converge
