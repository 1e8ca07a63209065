// The state of one packet of beams, a lane each. Include after hwy/foreach_target.h and hwy/highway.h.
#if defined(STRATA_TRACE_BEAM_PACKET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_BEAM_PACKET_INL_H_
#undef STRATA_TRACE_BEAM_PACKET_INL_H_
#else
#define STRATA_TRACE_BEAM_PACKET_INL_H_
#endif

#include <algorithm>

#include "src/trace/beam.h"
#include "src/trace/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// A beam ends once a step gains less than this many radii: narrower ones go further at less cost. Speed only.
inline constexpr float kLeastGain = 0.5f;

// A beam may end anywhere; one that grazes for so long leaves the rest to narrower ones.
inline constexpr std::uint32_t kMostBeamSteps = 200;

struct BeamPacket {
    alignas(HWY_MAX_BYTES) double origin[3][kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double direction[3][kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double noise_shift[3][kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double s[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double radius0[kMaxLanes] = {};  // with noise_radius
    alignas(HWY_MAX_BYTES) double spread[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) float noise_radius[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) float speed[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) float hint[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) float active[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double limit[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) std::uint32_t steps[kMaxLanes] = {};
    std::size_t beam[kMaxLanes] = {};
    double reach = 0.0;
    std::size_t active_count = 0;
};

HWY_INLINE void take_beam(BeamPacket& packet, std::size_t lane, const Beam& beam, std::size_t index, float first_hint,
                          bool is_planar) {
    for (int a = 0; a < 3; ++a) {
        packet.origin[a][lane] = beam.origin[a];
        packet.direction[a][lane] = beam.direction[a];
        packet.noise_shift[a][lane] = beam.noise_shift[a];
        packet.reach = std::max(packet.reach, std::abs(beam.origin[a] + beam.noise_shift[a]) + beam.limit);
    }
    packet.s[lane] = beam.start;
    packet.limit[lane] = beam.limit;
    packet.radius0[lane] = beam.radius0 + beam.noise_radius;
    packet.spread[lane] = beam.spread;
    packet.noise_radius[lane] = static_cast<float>(beam.noise_radius);
    packet.speed[lane] = domain_speed(is_planar, beam.direction);
    packet.hint[lane] = beam.hint > 0.0f ? beam.hint : first_hint;
    packet.active[lane] = 1.0f;
    packet.steps[lane] = 0;
    packet.beam[lane] = index;
    ++packet.active_count;
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
