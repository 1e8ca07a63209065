// Metadata of a PNG beyond ASCII. OpenImageIO 2.4 writes every text into a tEXt, which is Latin-1 by the format: other
// programs would show "Ã©" for "é". What goes into iTXt, which is UTF-8, is put between OpenImageIO and the file. It
// reads both.
#pragma once

#include <memory>

#include "src/image/metadata.h"
#include "src/image/openimageio.h"

namespace strata::image {

// What is to be written through instead of `bytes`, which it outlives: it adds an iTXt for each entry that
// needs_utf8_chunk() behind IHDR, where every reader finds it. Nothing where there is none.
std::unique_ptr<OIIO::Filesystem::IOProxy> add_utf8_text(OIIO::Filesystem::IOProxy& bytes, const Metadata& metadata);

}  // namespace strata::image
