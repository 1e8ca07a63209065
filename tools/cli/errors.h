// How the program ends when it cannot do what it was asked.
#pragma once

#include <stdexcept>

namespace strata::tools::cli {

inline constexpr int kExitRuntime = 1;   // something failed on the way
inline constexpr int kExitUsage = 2;     // the command line or the scene is wrong: nothing was started
inline constexpr int kExitSignal = 128;  // plus the signal's number

// A command line that cannot be used. what() is one line for the user.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace strata::tools::cli
