// Packages that only some commands need: installed by tools/setup/install where tools/strata started the program.
#pragma once

#include <string>

namespace strata::tools::cli {

// Installs a section of tools/setup/packages.txt, its words on standard error. False if nothing could be installed: the
// program was started without the launcher, which names its installer in STRATA_INSTALLER, or that failed.
bool install_packages(const std::string& section);

// Starts the launcher (STRATA_LAUNCHER) with the program's own words in this process's place, to build once more, with
// packages that came meanwhile. Returns, if it was not started by one, or is itself the second start.
void restart_rebuilt();

}  // namespace strata::tools::cli
