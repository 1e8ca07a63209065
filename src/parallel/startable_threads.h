// How many threads the system lets this process start.
#pragma once

namespace strata::parallel {

// Starts up to `wanted` threads that live at the same time, ends them, and returns how many there were: fewer than
// wanted where a limit of processes allows no more. TBB starts its threads from inside its own workers, where a refusal
// ends the program and no caller can catch it, so it is asked for no more than this. The answer holds as long as other
// processes under the same limit start none; where one does, the program still ends with a sentence
// (tools/cli/endings.h).
int startable_threads(int wanted);

}  // namespace strata::parallel
