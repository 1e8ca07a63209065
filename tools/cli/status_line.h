// A line on standard error that is written over: only where that is a terminal that can erase one.
#pragma once

#include <string>
#include <string_view>

namespace strata::tools::cli {

class StatusLine {
  public:
    // Nothing is ever shown in a pipe, or on a terminal that TERM calls dumb or leaves unnamed: editors and logs would
    // show the codes.
    StatusLine();
    ~StatusLine() { clear(); }
    StatusLine(const StatusLine&) = delete;
    StatusLine& operator=(const StatusLine&) = delete;

    // Cut to the width that the terminal has now, since a line that wraps cannot be erased.
    void show(std::string_view text);
    void clear();

  private:
    bool can_erase_;
    bool is_shown_ = false;
};

// The first `columns` characters of UTF-8 text.
std::string_view cut_to_columns(std::string_view text, std::size_t columns);

}  // namespace strata::tools::cli
