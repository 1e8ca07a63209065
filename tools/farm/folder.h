// A farm's folder, which all its machines see by the same name.
//
//   scene.toml      the scene with all settings       plan.json   what this is, for status
//   commands        what each task does, a line each  task.sh     does one of them (task.sh tells what is in tasks/)
//   program.sha256  of the program                    start       hands all tasks to the engine, again and again
//   parts/, tasks/  what tasks make, and tell         jobs        Slurm's numbers, once start was run
//   cancelled       is there: tasks stop
#pragma once

#include "tools/farm/plan.h"

namespace strata::tools::farm {

// Appears whole or not at all. Throws UsageError where there is one already.
void write_folder(const Plan& plan, const Request& request);

const char* task_script();

}  // namespace strata::tools::farm
