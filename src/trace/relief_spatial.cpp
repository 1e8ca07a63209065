// The formulas of reliefs over 3-D noise, compiled once for each SIMD target.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/trace/relief_spatial.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#define STRATA_RELIEF_FORMULAS
#include "src/trace/relief_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

template Enclosure enclose<false>(const ReliefPlan&, const WidePoint&, double, const ReliefPoints&);

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
