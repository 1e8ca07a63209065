// What the library's errors say.
#pragma once

#include <doctest/doctest.h>

#include <string>

#include "src/error.h"

// The message of the Error that action() throws; "no error" where it throws none.
template <class Action>
std::string message_of(const Action& action) {
    try {
        action();
    } catch (const strata::Error& error) {
        return error.what();
    }
    return "no error";
}

inline void check_says(const std::string& message, const std::string& part) {
    INFO(message);
    CHECK(message.find(part) != std::string::npos);
}
