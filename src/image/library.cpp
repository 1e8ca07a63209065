#include "src/image/library.h"

#include "src/image/openimageio.h"

namespace strata::image {

void configure_library() {
    [[maybe_unused]] static const bool once =
        OIIO::attribute("debug", 0) && OIIO::attribute("exr_threads", -1) && OIIO::attribute("threads", 1);
}

}  // namespace strata::image
