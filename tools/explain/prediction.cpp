#include "tools/explain/prediction.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>

#include "src/estimate/estimator.h"
#include "src/image/encode.h"
#include "src/integrate/make_image.h"
#include "src/parallel/processors.h"
#include "src/render/progressive.h"
#include "src/render/render.h"
#include "src/scene/needs.h"
#include "tools/explain/count_estimate.h"
#include "tools/explain/pilot.h"
#include "tools/job/cost_picture.h"

namespace strata::tools::explain {

namespace {

film::Rect owners_of(const film::Rect& window, const estimate::Estimator& estimator) {
    if (!estimator.shared()) return window;
    const int reach = estimator.weights().reach();
    return {window.x0 - reach, window.y0 - reach, window.x1 + reach, window.y1 + reach};
}

constexpr double kFilmBytes = 13;  // a pixel

// A run of shared samples, and the sums of the pixels that it is seen by.
double shared_memory(const film::Rect& window, const estimate::Estimator& estimator) {
    constexpr double kRunBytes = 8.4e6, kSampleBytes = 20, kMostRows = 48, kSumBytes = 32;
    const double width = window.width();
    const double rows = std::min(kMostRows, kRunBytes / (kSampleBytes * estimator.sample_count() * width));
    const double sum_rows = std::min<double>(rows + 2 * estimator.weights().reach() + 3, window.height());
    return std::min(kRunBytes, rows * width * kSampleBytes * estimator.sample_count()) + sum_rows * width * kSumBytes;
}

// Of one pass, only strips are held: in work, being encoded, and on their way through the encoder.
double strip_memory(const film::Rect& window) {
    constexpr double kStripsInWork = 3, kEncoderBytes = 24;
    const double strip_pixels = 1.0 * window.width() * std::min(image::kStripRows, window.height());
    return (kStripsInWork * kFilmBytes + kEncoderBytes) * strip_pixels;
}

// In the strips and the encoder; of what is drawn, the small pictures' sums, and drawing them, one after the other.
double aov_memory(const film::Rect& window, const integrate::ChannelSet& aovs) {
    if (aovs.empty()) return 0;
    constexpr double kFilmValueBytes = 4, kEncoderValueBytes = 8, kSumBytes = 17, kDrawnBytes = 42;
    const double strip_pixels = 1.0 * window.width() * std::min(image::kStripRows, window.height());
    const double longest = std::max(window.width(), window.height());
    const double block = std::ceil(longest / job::kLongestCostSide);
    const double small_pixels = 1.0 * window.width() * window.height() / (block * block);
    const auto values = static_cast<double>(aovs.values());
    const auto is_drawn_entry = [](const integrate::ChannelSet::Entry& aov) { return job::is_drawn(*aov.channel); };
    const auto drawn = static_cast<double>(std::ranges::count_if(aovs.entries(), is_drawn_entry));
    const double of_strips = strip_pixels * values * (3 * kFilmValueBytes + kEncoderValueBytes);
    return of_strips + (drawn > 0 ? small_pixels * (drawn * kSumBytes + kDrawnBytes) : 0.0);
}

// Samples, rays and beams on their way in a thread. A tile may be less than a batch.
double worker_memory(const estimate::Estimator& estimator, std::size_t batch_samples) {
    constexpr double kRaysBytes = 1.5e6, kSampleBytes = 225;
    const double tile = std::pow(render::RenderOptions{}.tile, 2) * estimator.sample_count();
    const double batch = static_cast<double>(batch_samples);
    return kRaysBytes + kSampleBytes * (estimator.shared() ? batch : std::min(batch, tile));
}

// The program with its libraries, of which this process has as many; what is on its way in each thread; the strips; of
// several passes what they are added up in.
double expected_memory(const film::Rect& window, const estimate::Estimator& estimator, std::size_t batch_samples,
                       int threads, int passes) {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const double pixels = 1.0 * window.width() * window.height();
    return 1024.0 * static_cast<double>(usage.ru_maxrss) + worker_memory(estimator, batch_samples) * threads +
           strip_memory(window) + (estimator.shared() ? shared_memory(window, estimator) : 0.0) +
           (passes > 1 ? 1.0 * render::bytes_a_pixel_of_passes(estimator) * pixels : 0.0);
}

// Counts that are known to be zero.
void leave_out(const scene::Scene& scene, Costs& costs) {
    using integrate::Counters;
    if (scene.image != scene::ImageKind::surface) {
        for (const auto& [name, count] : integrate::kCounters) costs.counts[count] = 0.0;
    }
    if (!scene::needs_shadow_rays(scene)) costs.counts[&Counters::shadow_rays] = 0.0;
    if (!scene::needs_sky_rays(scene)) costs.counts[&Counters::sky_rays] = 0.0;
    if (!scene::needs_water(scene)) costs.counts[&Counters::water_rays] = 0.0;
}

// What beams and windows do is done once for each cell of the screen that a batch touches, whatever its samples.
template <class Member>
double shared_part(const integrate::Counters& counters, Member member) {
    double sum = 0.0;
    for (const integrate::Phase phase :
         {integrate::Phase::beams, integrate::Phase::windows, integrate::Phase::sun_beams}) {
        sum += static_cast<double>(counters.phases[static_cast<std::size_t>(phase)].*member);
    }
    return sum;
}

// Of that part a render does `correction` times as much a ray as the pilot. By half the correction it may be wrong, and
// by kSharedDoubt anyway: batches begin and end within cells. Pilots that cast all rays of a built-in scene counted up
// to 18 % more of it than the renders.
double shared_doubt(double correction) {
    constexpr double kSharedDoubt = 0.3;
    return kSharedDoubt * correction + 0.5 * std::abs(1.0 - correction);
}

template <class Total, class Member>
BlockCount partly_shared(Total total, Member member, double correction) {
    const auto of = [=](const integrate::Counters& c) {
        return static_cast<double>(c.*total) + (correction - 1.0) * shared_part(c, member);
    };
    return {of, [=](const integrate::Counters& c) { return shared_doubt(correction) * shared_part(c, member); }};
}

// Lanes are not told by phase; they do the evaluations. Packets that are filled from small blocks run empty sooner than
// those of a render's batches: by up to 14 % of all lanes on the built-in scenes.
BlockCount of_lanes(double correction) {
    constexpr double kIdleDoubt = 0.2;
    const BlockCount lanes =
        partly_shared(&integrate::Counters::executed_lanes, &integrate::PhaseCost::noise_evaluations, correction);
    return {lanes.of, [=](const integrate::Counters& c) { return kIdleDoubt * lanes.of(c) + lanes.doubt(c); }};
}

// How many more of a count a ray from the eye may lead to: it hits once, or water, which sends on two rays that may
// each hit; and each hit sends one to the sun and one to the sky, which may hit in its turn.
double most_a_ray(const scene::Scene& scene, Count count) {
    const double sky_rays = scene::needs_sky_rays(scene) ? 1.0 + scene.sky.bounces : 0.0;
    const double water_rays = scene::needs_water(scene) ? 2.0 : 0.0, seen = 1.0 + water_rays;
    if (count == &integrate::Counters::water_rays) return water_rays;
    if (count == &integrate::Counters::sky_rays) return sky_rays * seen;
    return count == &integrate::Counters::shadow_rays ? (1.0 + sky_rays) * seen : 1.0;
}

// What beams and windows have no part in is counted ray by ray.
BlockCount block_count(const scene::Scene& scene, Count count, double correction) {
    using integrate::Counters, integrate::PhaseCost;
    if (count == &Counters::noise_evaluations) return partly_shared(count, &PhaseCost::noise_evaluations, correction);
    if (count == &Counters::steps) return partly_shared(count, &PhaseCost::steps, correction);
    if (count == &Counters::executed_lanes) return of_lanes(correction);
    return {[=](const Counters& c) { return static_cast<double>(c.*count); }, {}, most_a_ray(scene, count)};
}

void extrapolate(const scene::Scene& scene, const PilotRun& run, double estimator_s, int threads,
                 Prediction& prediction) {
    Costs& costs = prediction.costs;
    const auto rays = static_cast<double>(costs.rays);
    for (const auto& [name, count] : integrate::kCounters) {
        std::optional<double>& cost = costs.counts[count];
        const CountEstimate between = cost
                                          ? CountEstimate{*cost, *cost, *cost}
                                          : estimate_count(run, rays, block_count(scene, count, run.shared_correction));
        prediction.between[count] = between;
        cost = between.value;
    }
    // Small pictures of composed reliefs idle in up to half of a pilot's lanes; what is sure is that each evaluation
    // takes a lane.
    std::optional<CountEstimate>& lanes = prediction.between[&integrate::Counters::executed_lanes];
    const std::optional<CountEstimate>& evaluations = prediction.between[&integrate::Counters::noise_evaluations];
    if (lanes && evaluations && lanes->low < lanes->high) lanes->low = std::min(lanes->low, evaluations->low);
    costs.cpu_seconds = rays / static_cast<double>(run.counters.rays) * run.cpu_seconds + estimator_s * rays;
    costs.seconds = *costs.cpu_seconds / threads;
}

}  // namespace

std::uint64_t pilot_rays(std::uint64_t rays, integrate::Tracer tracer) {
    const std::uint64_t most = tracer == integrate::Tracer::reference ? kMostReferenceRays : kMostPilotRays;
    const auto share = static_cast<std::uint64_t>(kPilotFraction * static_cast<double>(rays));
    const std::uint64_t wanted = std::clamp(share, kLeastPilotRays, most);
    return 2 * wanted >= rays ? std::min(rays, most) : wanted;
}

std::uint64_t count_rays(const scene::Scene& scene, const film::Rect& window) {
    const estimate::Estimator estimator(estimate::estimator_settings(scene));
    const film::Rect owners = owners_of(window, estimator);
    return std::uint64_t{1} * static_cast<std::uint64_t>(owners.width()) * static_cast<std::uint64_t>(owners.height()) *
           static_cast<std::uint64_t>(estimator.sample_count());
}

Prediction predict(const scene::Scene& scene, const film::Rect& window, const PredictionSettings& settings) {
    const estimate::EstimatorSettings sampling = estimate::estimator_settings(scene);
    const estimate::Estimator estimator(sampling);
    Prediction prediction;
    prediction.threads = settings.threads > 0 ? settings.threads : parallel::available_processors();
    Costs& costs = prediction.costs;
    costs.rays = count_rays(scene, window);
    leave_out(scene, costs);
    const auto image = integrate::make_image(scene, settings.tracer);
    costs.peak_memory_bytes =
        expected_memory(window, estimator, image->batch_samples(), prediction.threads, settings.passes) +
        aov_memory(window, settings.aovs);
    if (settings.with_pilot) {
        const PilotRun run =
            run_pilot(*image, sampling, owners_of(window, estimator), pilot_rays(costs.rays, settings.tracer));
        prediction.pilot = Pilot{run.counters.rays, run.cpu_seconds};
        extrapolate(scene, run, estimator_seconds_a_ray(sampling), prediction.threads, prediction);
    }
    return prediction;
}

}  // namespace strata::tools::explain
