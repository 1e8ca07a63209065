// How an EXR keeps radiance: --format, and what is said where a half could not hold it.
#pragma once

#include <string>

#include "src/image/encode.h"

namespace strata::tools::job {

// "half" or "float". Throws UsageError, which tells what is `allowed`.
image::ExrFormat parse_exr_format(const std::string& name, const char* allowed = "half, float");
const char* name_of(image::ExrFormat format);

// For image::WriteOptions::warn.
void warn_of_clipping(const std::string& what);

}  // namespace strata::tools::job
