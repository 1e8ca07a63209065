// What a node's formula may ask about the node itself, whatever the numbers.
#pragma once

#include <cstddef>

#include "noise/bounds.h"
#include "noise/relief/relief.h"

namespace strata::noise {

class ReliefFrame {
  public:
    ReliefFrame(const ReliefPart& part, int dimensions) : part_(&part), dimensions_(dimensions) {}

    std::size_t octaves() const { return part_->octaves.size(); }
    std::size_t inputs() const { return part_->inputs.size(); }
    std::size_t dimensions() const { return static_cast<std::size_t>(dimensions_); }
    double amplitude(std::size_t k) const { return part_->octaves[k].amplitude; }
    double frequency(std::size_t k) const { return part_->octaves[k].frequency; }
    double amplitude_from(std::size_t k) const { return part_->amplitude_from[k]; }

    const PlanTurn* turn(std::size_t k) const { return part_->turns.empty() ? nullptr : &part_->turns[k]; }

    // The largest value of an octave's noise.
    double peak() const { return bounds().value; }

  protected:
    const NoiseBounds& bounds() const { return dimensions_ == 2 ? kBounds2 : kBounds3; }
    const ReliefPart& part() const { return *part_; }
    bool is_planar() const { return dimensions_ == 2; }

  private:
    const ReliefPart* part_;
    int dimensions_;
};

}  // namespace strata::noise
