// Judges what a tracer reports of a ray by the two promises that it makes, given f along the ray:
//
//   (i)  no stretch with f < 0 longer than delta lies before the reported hit, or before the ray's end for a miss;
//   (ii) within delta of a reported hit, along the ray, lies a point with f <= 0.
//
// f is a callable t -> Probe {f, clear}: f does not change sign at distances below `clear` from t. delta is a callable
// t -> length that does not decrease.
//
// (i) walks along the ray by the larger of `clear` and delta/4: a longer step is proven free of roots, so every stretch
// longer than delta shows as at least three samples in a row with f < 0. Its ends are then found by bisection, and its
// inside walked again at delta/1024 before it is called a violation. (ii) bisects the neighbourhood until a point with
// f <= 0 is found or f > 0 is proven.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/stability/oracles/field_oracle.h"

namespace strata::oracle {

struct Claim {
    bool hit = false;
    double t = 0.0;
};

struct Verdict {
    bool missed = false;     // (i) is violated by the stretch below
    Span stretch;            // the first stretch with f < 0 longer than delta before the claim
    bool unfounded = false;  // (ii) is violated: f > 0 within delta of the hit
    bool undecided = false;  // (ii) is neither shown nor refuted within the probes allowed: f almost touches 0 there
    bool cut_short = false;  // (i) was looked at up to the walk's limit of probes only
    double thickest = 0.0;   // longest stretch with f < 0 before the claim, over its delta
    long probes = 0;

    bool ok() const { return !missed && !unfounded; }
};

template <class RayFunction, class Delta>
class RayJudge {
  public:
    // most_probes: of the walk along the ray.
    RayJudge(const RayFunction& f, const Delta& delta, long most_probes = kNoLimit)
        : f_(f), delta_(delta), most_probes_(most_probes) {}

    static constexpr long kNoLimit = std::numeric_limits<long>::max();

    // span is the part of the ray where there may be a surface. A hit before its begin or after its end is founded if
    // it is within delta of a point with f <= 0 inside.
    Verdict judge(const Span& span, const Claim& claim) {
        verdict_ = {};
        shortest_step_ = kShortestStep * std::min(1.0, span.end);
        if (span.begin <= span.end) find_missed({span.begin, claim.hit ? std::min(span.end, claim.t) : span.end});
        if (claim.hit) find_support(span, claim.t);
        return verdict_;
    }

  private:
    // Of the ray's length, if that is below 1: the walk's steps do not get shorter, where delta vanishes at the origin.
    static constexpr double kShortestStep = 1e-11;
    static constexpr int kMaxHalvings = 40;
    static constexpr long kMaxSupportProbes = 200000;

    Probe probe(double t) {
        ++verdict_.probes;
        return f_(t);
    }

    // The root between an outside and an inside point, as the innermost point known to have f < 0.
    double bisect(double outside, double inside) {
        for (int i = 0; i < kMaxHalvings; ++i) {
            const double middle = 0.5 * (outside + inside);
            if (middle == outside || middle == inside) break;
            (probe(middle).f < 0.0 ? inside : outside) = middle;
        }
        return inside;
    }

    void find_missed(const Span& range) {
        bool is_inside = false;
        double inside_since = 0.0;
        double t = range.begin;
        Probe here = probe(t);
        if (here.f < 0.0) is_inside = true, inside_since = t;
        while (t < range.end && !verdict_.missed) {
            const double next = std::min(range.end, t + std::max({here.clear, delta_(t) / 4.0, shortest_step_}));
            if (next == t) break;
            if (verdict_.probes > most_probes_) {
                verdict_.cut_short = true;
                return;
            }
            here = probe(next);
            if (here.f < 0.0) {
                if (!is_inside) inside_since = bisect(t, next);
                is_inside = true;
            } else if (is_inside) {
                weigh({inside_since, bisect(next, t)});
                is_inside = false;
            }
            t = next;
        }
        if (is_inside && !verdict_.missed) weigh({inside_since, range.end});
    }

    // A stretch whose samples were all inside: is some part of it that is longer than delta inside throughout?
    void weigh(const Span& stretch) {
        const double limit = delta_(stretch.end);
        const double length = stretch.end - stretch.begin;
        if (length <= limit) {
            if (limit > 0.0) verdict_.thickest = std::max(verdict_.thickest, length / limit);
            return;
        }
        Span part{stretch.begin, stretch.begin};
        while (part.end < stretch.end && part.end - part.begin <= limit && verdict_.probes <= most_probes_) {
            const Probe here = probe(part.end);
            const double least = limit > 0.0 ? limit / 1024.0 : shortest_step_;
            part.end = std::min(stretch.end, part.end + std::max(here.clear, least));
            if (!(here.f < 0.0)) part.begin = part.end;
        }
        if (part.end - part.begin <= limit) return;
        verdict_.missed = true;
        verdict_.stretch = stretch;
        verdict_.thickest = length / limit;
    }

    enum class Support { none, found, unsure };

    Support search(double lo, double hi, int halvings) {
        const double middle = 0.5 * (lo + hi);
        const Probe here = probe(middle);
        if (here.f <= 0.0) return Support::found;
        if (here.clear > 0.5 * (hi - lo)) return Support::none;
        if (halvings == 0 || verdict_.probes > last_probe_ || middle <= lo || middle >= hi) return Support::unsure;
        const Support first = search(lo, middle, halvings - 1);
        if (first == Support::found) return first;
        const Support second = search(middle, hi, halvings - 1);
        return second == Support::none ? first : second;
    }

    void find_support(const Span& span, double t) {
        const double reach = delta_(t);
        const double lo = std::max(span.begin, t - reach), hi = std::min(span.end, t + reach);
        if (!std::isfinite(t) || !(lo <= hi)) {
            verdict_.unfounded = true;
            return;
        }
        last_probe_ = verdict_.probes + kMaxSupportProbes;
        // A fixed depth first, so that one hard spot does not use up the probes.
        Support support = probe(lo).f <= 0.0 || probe(hi).f <= 0.0 ? Support::found : Support::unsure;
        for (int halvings = 7; support == Support::unsure && halvings <= kMaxHalvings; halvings += 11)
            support = search(lo, hi, halvings);
        verdict_.unfounded = support == Support::none;
        verdict_.undecided = support == Support::unsure;
    }

    const RayFunction& f_;
    const Delta& delta_;
    long most_probes_;
    Verdict verdict_;
    long last_probe_ = 0;
    double shortest_step_ = kShortestStep;
};

template <class RayFunction, class Delta>
Verdict judge_ray(const RayFunction& f, const Span& span, const Delta& delta, const Claim& claim,
                  long most_probes = RayJudge<RayFunction, Delta>::kNoLimit) {
    return RayJudge<RayFunction, Delta>(f, delta, most_probes).judge(span, claim);
}

// The ray p + t direction, t in [0, limit], direction of unit length, against a surface.
// `field` is a FieldOracle, or has its probe and shape.
template <class Field, class Delta>
Verdict judge_ray(const Field& field, const Vec& p, const Vec& direction, double limit, const Delta& delta,
                  const Claim& claim, long most_probes = std::numeric_limits<long>::max()) {
    const auto f = [&](double t) {
        return field.probe({p[0] + t * direction[0], p[1] + t * direction[1], p[2] + t * direction[2]}, direction);
    };
    return judge_ray(f, clip(field.shape(), p, direction, limit), delta, claim, most_probes);
}

}  // namespace strata::oracle
