// The floors' exceptions become the library's one.
#pragma once

#include <exception>
#include <new>

#include "src/error.h"

namespace strata {

// What action() gives; whatever it throws, as an Error.
template <class Action>
auto translated(const Action& action) {
    try {
        return action();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error("out of memory; fewer pixels at once need less");
    } catch (const std::exception& error) {
        throw Error(error.what());
    }
}

}  // namespace strata
