// The functions of numbers that reliefs are written with, for doubles; vectors of floats have the same ones (Lanes in
// src/trace/enclosure-inl.h). Include after hwy/highway.h.
#if defined(STRATA_NOISE_RELIEF_NUMBERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_NUMBERS_INL_H_
#undef STRATA_NOISE_RELIEF_NUMBERS_INL_H_
#else
#define STRATA_NOISE_RELIEF_NUMBERS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

template <class V>
struct Fixed;

template <>
struct Fixed<double> {
    static double of(double x) { return x; }
};

// A number of type V that is the same everywhere.
template <class V>
HWY_INLINE V fixed(double x) {
    return Fixed<V>::of(x);
}

inline double least(double a, double b) { return std::min(a, b); }
inline double greatest(double a, double b) { return std::max(a, b); }
inline double root(double a) { return std::sqrt(a); }
inline double size(double a) { return std::abs(a); }
inline double whole(double a) { return std::floor(a); }
inline double pick(bool condition, double yes, double no) { return condition ? yes : no; }

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
