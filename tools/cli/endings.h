// How the program ends when it is made to: by a signal, or by an error that nobody can catch.
#pragma once

#include <exception>
#include <string>

namespace strata::tools::cli {

// Call first. Signals that end the program end the programs that it runs too and remove its hidden files.
void prepare_endings();

// what() of an error, for the user; of a thread that could not be started, what that means.
std::string message_of(const std::exception& error);

}  // namespace strata::tools::cli
