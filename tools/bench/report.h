// A run as a table for people, as JSON for programs and for --against, and as a plot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/bench/against.h"
#include "tools/bench/figures.h"
#include "tools/bench/results.h"
#include "tools/cli/planned_files.h"
#include "tools/report/plot.h"

namespace strata::tools::bench {

// earlier: empty without --against.
std::string text_report(const Results& results, const std::vector<Figure>& figures,
                        const std::vector<Comparison>& earlier);

std::string json_report(const Results& results, const std::vector<Figure>& figures,
                        const std::vector<Comparison>& earlier);

// A panel for each curve that was measured, and one of the time shares where they are known; no panel: nothing to draw.
report::Plot plot_report(const Results& results);

// The files that write_report() puts into a folder.
std::vector<std::filesystem::path> report_files(const std::filesystem::path& folder);

// Numbers first, then the plot, if it has a panel: files that are planned, each failing alone.
void write_report(const std::filesystem::path& folder, const Results& results, const std::vector<Figure>& figures,
                  const std::vector<Comparison>& earlier, cli::PlannedFiles& files);

}  // namespace strata::tools::bench
