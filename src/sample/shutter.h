// Sample times. Of the paper's equation 18: as many strata of time as there are samples, jittered, dealt to the samples
// of a pixel or cell by a permutation of its own, then distributed by the B-spline of order l over the open shutter.
#pragma once

#include <cstdint>
#include <span>

namespace strata::sample {

struct Shutter {
    double frame_time_s = 0;  // t_k = k / fps
    double open_s = 0;        // s >= 0; 0 is an instant: every sample at t_k, and nothing is drawn

    bool instant() const { return open_s <= 0; }
    double middle_s() const { return frame_time_s + 0.5 * open_s; }
    // t = t_k + s/2 + s (x - l/2), given x - l/2 for x distributed as n_l.
    double time_s(double centred) const { return middle_s() + open_s * centred; }
};

// The time strata of every sample, folded (strata.h). `permutation` is scratch of the same length.
void folded_times(std::uint64_t cell_key, std::span<std::uint32_t> permutation, std::span<float> q);

// Times without strata, each independent of the others.
void folded_random_times(std::uint64_t cell_key, std::span<float> q);

}  // namespace strata::sample
