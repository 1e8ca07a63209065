// OpenImageIO's headers, to be included by way of this one. They ask for fmt without its library; with fmt's own header
// read first they take the library, and a file compiles in a third of the time.
#pragma once

#include <fmt/format.h>
// Not before the line above.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
