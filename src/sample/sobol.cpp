#include "src/sample/sobol.h"

namespace strata::sample {

SobolTable::SobolTable(std::uint32_t n) : second_reversed_(n) {
    for (std::uint32_t i = 0; i < n; ++i) second_reversed_[i] = reverse_bits(sobol_point(i)[1]);
}

}  // namespace strata::sample
