// A sweep's figures as sweep.csv and sweep.json.
#pragma once

#include <filesystem>
#include <span>

#include "tools/cli/planned_files.h"
#include "tools/job/ledger.h"
#include "tools/sweep/job.h"
#include "tools/sweep/results.h"

namespace strata::tools::sweep {

// Leaves a file that has these bytes already alone.
void write_if_changed(cli::PlannedFiles& files, const std::filesystem::path& path,
                      std::span<const unsigned char> bytes);

// sweep.json of a sweep that is not finished: the costs so far.
void write_costs(cli::PlannedFiles& files, const Job& job, const job::Ledger& ledger);

// Both tables. Equal sweeps give equal tables, apart from seconds, cpu_seconds and threads.
void write_tables(cli::PlannedFiles& files, const Job& job, const job::Ledger& ledger, const Results& results);

}  // namespace strata::tools::sweep
