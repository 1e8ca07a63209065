// What keeps a journal from being read or written, with the system's reason.
#pragma once

#include <stdexcept>

namespace strata::journal {

struct JournalError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Another process has the journal open, on this machine or another one that shares the folder.
struct JournalInUse : JournalError {
    using JournalError::JournalError;
};

}  // namespace strata::journal
