// The folder of a report: ready before what is to be reported is measured.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/cli/planned_files.h"
#include "tools/report/plot.h"

namespace strata::tools::report {

// Makes the folder unless it is there. Throws ImageError.
void make_folder(const std::filesystem::path& folder);

// The same, begins the files and finds the plotter. Throws ImageError and ProcessError.
std::filesystem::path prepare_folder(const std::filesystem::path& folder,
                                     std::vector<std::filesystem::path> (*files_in)(const std::filesystem::path&),
                                     cli::PlannedFiles& files);

// NAME.png and NAME.svg in the folder, planned files that fail each alone. A plot without panels has nothing to draw.
void write_plots(const Plot& plot, const std::filesystem::path& folder, const std::string& name,
                 cli::PlannedFiles& files);

}  // namespace strata::tools::report
