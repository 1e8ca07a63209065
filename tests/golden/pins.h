// Pins: what was measured once, as text files that a diff of them can be read.
#pragma once

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/golden/environment.h"
#include "tests/golden/measure.h"

namespace strata::golden {

class PinError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// Of one SIMD target.
struct Pins {
    Environment environment;
    std::map<std::string, Record> scenes;  // by name
};

// As TOML, a table for each scene with a line for each phase; counts of 0 are left out.
std::string print_pins(const Pins& pins, const std::string& target);

// Throws PinError for text that print_pins() did not write.
Pins parse_pins(const std::string& text, const std::string& source_name);

// Throws PinError, naming the command that makes it, for a file that is not there.
Pins load_pins(const std::filesystem::path& path);

// What differs, a line each: "shadows.steps: expected 12, got 13". A count that one of them lacks is 0 there.
std::vector<std::string> differences(const Record& expected, const Record& got);

}  // namespace strata::golden
