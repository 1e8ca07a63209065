// Reliefs on a vector of points, for the tracers. The relief's formulas, of which there are many for the compiler, are
// in relief_planar.cpp and relief_spatial.cpp alone. Include after hwy/foreach_target.h and hwy/highway.h.
#if defined(STRATA_TRACE_RELIEF_ENCLOSURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_RELIEF_ENCLOSURE_INL_H_
#undef STRATA_TRACE_RELIEF_ENCLOSURE_INL_H_
#else
#define STRATA_TRACE_RELIEF_ENCLOSURE_INL_H_
#endif

#include "src/trace/enclosure-inl.h"
#include "src/trace/relief_plan.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// The whole relief at a vector of points, reach a bound of their coordinates.
template <bool kPlanar>
Enclosure enclose(const ReliefPlan& plan, const WidePoint& x, double reach, const ReliefPoints& points);

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
