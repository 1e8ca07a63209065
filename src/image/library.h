#pragma once

namespace strata::image {

// Sets OpenImageIO up, once for the process: one thread, so that files share nothing with the render's, and no
// debugging notes on standard error. Call before any other use of it.
void configure_library();

}  // namespace strata::image
