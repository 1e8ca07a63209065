// A canvas as OpenImageIO sees it, for the files that draw with ImageBufAlgo.
#pragma once

#include "src/image/canvas.h"
#include "src/image/openimageio.h"

namespace strata::image {

// The canvas's own memory, which must outlive the buffer; drawing into the one changes the other.
OIIO::ImageBuf buffer_of(Canvas& canvas);

// The same, to be read from only.
OIIO::ImageBuf buffer_of(const Canvas& canvas);

// Throws ImageError with OpenImageIO's reason unless `done`.
void require_drawn(bool done, const OIIO::ImageBuf& buffer);

}  // namespace strata::image
