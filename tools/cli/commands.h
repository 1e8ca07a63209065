// The subcommands. Each adds itself to the program and runs when it was chosen, leaving its exit code.
#pragma once

#include "tools/cli/command_line.h"

namespace strata::tools {

void add_render_command(Command& program, int& exit_code);
void add_scenes_command(Command& program, int& exit_code);
void add_converge_command(Command& program, int& exit_code);
void add_probe_command(Command& program, int& exit_code);
void add_strip_command(Command& program, int& exit_code);
void add_sweep_command(Command& program, int& exit_code);
void add_animate_command(Command& program, int& exit_code);
void add_figures_command(Command& program, int& exit_code);
void add_stability_command(Command& program, int& exit_code);
void add_explain_command(Command& program, int& exit_code);
void add_bench_command(Command& program, int& exit_code);

}  // namespace strata::tools
