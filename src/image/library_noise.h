// What the libraries below OpenImageIO print on standard error of their own accord, such as "libpng error: ...".
#pragma once

#include <string>

namespace strata::image {

// While it lives, what is written to standard error is kept, not shown: our own message says what is wrong, once, with
// the file's name. It is the process's standard error: only for the short while of a call into the library, or of
// reading one picture, with no render under way that prints its progress.
class LibraryNoise {
  public:
    LibraryNoise();
    ~LibraryNoise();
    LibraryNoise(const LibraryNoise&) = delete;
    LibraryNoise& operator=(const LibraryNoise&) = delete;

    // The first line of what was printed, without the library's name for it ("libpng error: "); empty if nothing was.
    std::string text() const;

    // OpenImageIO's error, in one line, with that line beside it unless it says the same.
    std::string explain(const std::string& error) const;

  private:
    int kept_ = -1;   // an unnamed file
    int shown_ = -1;  // standard error as it was
};

}  // namespace strata::image
