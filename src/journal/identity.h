// Of which work a journal, or a part of a picture, is: names and values that must all be the same for it to be gone on
// with.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src/journal/payload.h"

namespace strata::journal {

class Identity {
  public:
    void set(std::string name, std::string value) { entries_.emplace_back(std::move(name), std::move(value)); }

    // A text of lines "name = value" below lines "[section]", as a scene is printed: an entry "section.name" each.
    // Sections that come several times are numbered from the second on, and so are names. Remarks (#) do not count,
    // other lines do as they are.
    void set_lines(std::string_view text);

    void write(PayloadWriter& payload) const;
    static Identity read(PayloadReader& payload);

    const std::vector<std::pair<std::string, std::string>>& entries() const { return entries_; }
    bool operator==(const Identity&) const = default;

  private:
    std::vector<std::pair<std::string, std::string>> entries_;
};

// A line each, "sampling.N: 2 there, 4 here", at most `most` of them and then how many there are more; empty where the
// two are equal.
std::vector<std::string> differences(const Identity& there, const Identity& here, std::size_t most = 12);

}  // namespace strata::journal
