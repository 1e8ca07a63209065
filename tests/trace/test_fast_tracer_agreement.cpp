// The fast tracer's answers on different SIMD targets, and beside the reference tracer's.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/trace/fast_tracer.h"
#include "src/trace/reference_tracer.h"
#include "tests/trace/fast_tracer_cases.h"

using namespace strata;
using namespace strata::trace_test;
using trace::Hit;
using trace::HitState;
using trace::Ray;

namespace {

struct Agreement {
    int rays = 0, both_hit = 0, apart = 0, one_sided = 0;
    double farthest = 0.0;  // of hits within 2 delta
    std::vector<Ray> in_question;
    std::vector<Hit> claims_a, claims_b;
};

void compare(std::span<const Ray> rays, std::span<const Hit> a, std::span<const Hit> b, Agreement& sum) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
        ++sum.rays;
        const bool hit_a = a[i].state == HitState::hit, hit_b = b[i].state == HitState::hit;
        if (!hit_a && !hit_b) continue;
        if (hit_a && hit_b) {
            ++sum.both_hit;
            const double width = delta(rays[i], std::max(a[i].s, b[i].s));
            const double share = std::abs(a[i].s - b[i].s) / std::max(width, 1e-12);
            if (share <= 2.0) {
                sum.farthest = std::max(sum.farthest, share);
                continue;
            }
        }
        ++(hit_a && hit_b ? sum.apart : sum.one_sided);
        sum.in_question.push_back(rays[i]);
        sum.claims_a.push_back(a[i]);
        sum.claims_b.push_back(b[i]);
    }
}

// Both may differ only where each keeps its promises: at silhouettes thinner than delta.
void check_explained(const scene::Surface& surface, const Agreement& found) {
    const Judgement a = judge(surface, found.in_question, found.claims_a);
    const Judgement b = judge(surface, found.in_question, found.claims_b);
    CHECK(a.missed + a.unfounded == 0);
    CHECK(b.missed + b.unfounded == 0);
}

}  // namespace

TEST_CASE("SIMD targets agree within 2 delta, or both keep their promises at a silhouette") {
    Random random(53);
    Agreement total;
    for (const scene::Surface& surface : surfaces(random, 8)) {
        const trace::Field field(surface);
        const trace::FastTracer tracer(field);
        const std::vector<Ray> rays = hard_rays(random, field, tracer, 600);
        std::vector<Hit> first;
        on_every_target([&](const std::string&) {
            Traced found = trace_all(tracer, rays);
            if (first.empty()) {
                first = std::move(found.hits);
                return;
            }
            Agreement here;
            compare(rays, first, found.hits, here);
            check_explained(surface, here);
            total.rays += here.rays;
            total.both_hit += here.both_hit;
            total.apart += here.apart;
            total.one_sided += here.one_sided;
            total.farthest = std::max(total.farthest, here.farthest);
        });
    }
    MESSAGE(total.rays << " pairs, " << total.both_hit << " both hit, farthest " << total.farthest << " delta; "
                       << total.apart << " hit different folds, " << total.one_sided << " hit on one target only");
    CHECK(total.both_hit * 4 > total.rays);
    CHECK((total.apart + total.one_sided) * 100 <= total.rays);
}

TEST_CASE("the reference tracer agrees within 2 delta, or both keep their promises at a silhouette") {
    Random random(54);
    Agreement total;
    for (const scene::Surface& surface : surfaces(random, 0)) {
        const trace::Field field(surface);
        const trace::FastTracer tracer(field);
        const std::vector<Ray> rays = hard_rays(random, field, tracer, 160);
        const Traced found = trace_all(tracer, rays);
        std::vector<Hit> expected(rays.size());
        trace::TraceCounters counters;
        trace::trace_reference(field, rays, expected, counters);
        Agreement here;
        compare(rays, found.hits, expected, here);
        check_explained(surface, here);
        total.rays += here.rays;
        total.both_hit += here.both_hit;
        total.apart += here.apart;
        total.one_sided += here.one_sided;
        total.farthest = std::max(total.farthest, here.farthest);
    }
    MESSAGE(total.rays << " rays, " << total.both_hit << " both hit, farthest " << total.farthest << " delta; "
                       << total.apart << " hit different folds, " << total.one_sided << " hit with one tracer only");
    CHECK(total.both_hit * 4 > total.rays);
    CHECK((total.apart + total.one_sided) * 10 <= total.rays);
}
