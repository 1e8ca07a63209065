// More random numbers for a sample than its place and time: for the light that it gathers. They belong to the sample
// alone, yet those of the n samples of one pixel or cell are stratified among each other: dimension pair p takes the
// first n points of an Owen-scrambled Sobol sequence, dealt out to the samples in an order of its own (padding: Kollig
// and Keller, "Efficient multidimensional sampling", 2002).
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "src/sample/counter_hash.h"
#include "src/sample/sobol.h"

namespace strata::sample {

// Which sample it is: number `index` of the `count` that one pixel or cell has, which `key` stands for.
struct SampleId {
    std::uint64_t key = 0;
    std::uint32_t index = 0, count = 1;
};

// The ids of samples that belong to pixels or cells, one after the other and as many for each.
struct SampleOwners {
    std::span<const std::uint64_t> keys;  // of each owner; empty: samples have no ids
    std::uint32_t samples_each = 1;
    std::size_t first = 0;  // where in the owners' samples these begin

    SampleId id(std::size_t i) const {
        const std::size_t place = first + i;
        return {keys[place / samples_each], static_cast<std::uint32_t>(place % samples_each), samples_each};
    }
};

// The id of a sample that belongs to no pixel or cell: it has its place and time alone.
constexpr SampleId id_of_place(double u, double v, double t) {
    std::uint64_t key = 0;
    for (const double x : {u, v, t}) key = noise::mix64(key + kCounterStride + std::bit_cast<std::uint64_t>(x));
    return {.key = key};
}

// The place of `index` in an order of 0..n-1 that a key draws, without drawing the others: a bijection of the next
// power of two is followed until it comes back below n (cycle walking: Black & Rogaway, "Ciphers with arbitrary finite
// domains", 2002). n >= 1, index < n.
constexpr std::uint32_t place_in_order(std::uint32_t index, std::uint32_t n, std::uint64_t key) {
    const std::uint32_t mask = std::bit_ceil(n) - 1u;
    const int shift = (std::bit_width(mask) + 1) / 2;
    std::uint32_t x = index;
    do {
        std::uint64_t mixed = key;
        for (int round = 0; round < 4; ++round) {  // each line of which can be undone
            mixed = noise::mix64(mixed + kCounterStride);
            x = (x + high_word(mixed)) & mask;
            x = (x * ((low_word(mixed) >> 3) | 1u)) & mask;
            x ^= x >> shift;
            x = (x * ((low_word(mixed) >> 17) | 1u)) & mask;
            x ^= x >> 1;
        }
    } while (x >= n);
    return x;
}

// Two numbers in (0,1).
inline std::array<double, 2> dimension_pair(const SampleId& sample, std::uint32_t pair) {
    constexpr std::uint64_t kFirst = 3;  // after those of Stream
    const std::uint64_t key = stream_key(sample.key, static_cast<Stream>(kFirst + pair));
    const std::uint64_t scramble = counter_hash(key, 0);
    const auto point = sobol_point(place_in_order(sample.index, sample.count, counter_hash(key, 1)));
    const std::uint32_t u = owen_scramble_reversed(reverse_bits(point[0]), high_word(scramble));
    const std::uint32_t v = owen_scramble_reversed(reverse_bits(point[1]), low_word(scramble));
    return {(u + 0.5) * 0x1p-32, (v + 0.5) * 0x1p-32};
}

}  // namespace strata::sample
