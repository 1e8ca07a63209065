// What a report says of the machine that its times were measured on.
#pragma once

#include <string>

namespace strata::tools::report {

// The processor's name as the system tells it.
std::string processor_name();

}  // namespace strata::tools::report
