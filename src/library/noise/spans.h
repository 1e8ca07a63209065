// What all batches refuse: spans of unlike length.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "src/error.h"

namespace strata {

inline void check_length(const char* name, std::size_t index, std::size_t length, std::size_t expected) {
    if (length == expected) return;
    throw Error(std::string(name) + "[" + std::to_string(index) + "]: " + std::to_string(length) +
                " elements, allowed: as many as `value` has, " + std::to_string(expected));
}

template <std::size_t D>
void check_spans(const std::array<std::span<const float>, D>& offset, std::span<float> value,
                 std::span<const std::span<float>> gradient = {}, std::span<const std::span<float>> hessian = {}) {
    for (std::size_t a = 0; a < D; ++a) check_length("offset", a, offset[a].size(), value.size());
    for (std::size_t a = 0; a < gradient.size(); ++a) check_length("axis", a, gradient[a].size(), value.size());
    for (std::size_t e = 0; e < hessian.size(); ++e) check_length("entry", e, hessian[e].size(), value.size());
}

}  // namespace strata
