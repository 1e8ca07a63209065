// Where in the unit square the N x N samples of a pixel or cell lie. Sample i of the stratified pattern is in column
// i mod N, row i / N.
#pragma once

#include <cstdint>
#include <span>

#include "src/sample/sobol.h"

namespace strata::sample {

enum class PatternKind { stratified, random, sobol };

class Pattern {
  public:
    Pattern(PatternKind kind, int samples_per_side);

    int size() const { return static_cast<int>(N_ * N_); }

    // Both coordinates of every sample, folded (strata.h): arguments of an inverse distribution function.
    void folded(std::uint64_t cell_key, std::span<float> u, std::span<float> v) const;

    // Both coordinates of every sample in [0,1).
    void positions(std::uint64_t cell_key, std::span<float> u, std::span<float> v) const;

  private:
    PatternKind kind_;
    std::uint32_t N_;
    SobolTable sobol_;  // empty for other kinds
};

}  // namespace strata::sample
