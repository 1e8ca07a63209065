#include "tools/job/pass_journal.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "src/image/encode.h"
#include "src/journal/journal_error.h"
#include "src/journal/pixel_record.h"
#include "src/parallel/cpu_clock.h"

namespace strata::tools::job {
namespace {

using journal::PixelPart;
using journal::SampleLayout;

// What a film or a sum has of some pixels.
template <class T>
PixelPart gather(std::span<const T> values, const SampleLayout& layout, const film::Rect& window,
                 std::span<const film::Rect> rects) {
    return journal::part_of(layout, journal::gather(values, 1, window, rects));
}

template <class T>
void scatter(const PixelPart& part, std::span<T> values, const film::Rect& window, std::span<const film::Rect> rects) {
    journal::for_each_row(window, rects, [&](std::size_t first, std::size_t in_part, std::size_t pixels) {
        std::memcpy(static_cast<void*>(values.data() + first), part.samples.data() + in_part * sizeof(T),
                    pixels * sizeof(T));
    });
}

constexpr SampleLayout kColour{3, 4}, kWeight{1, 8}, kSums{3, 8}, kMoments{4, 4};

std::uint32_t type_of(JournalRecord record) { return static_cast<std::uint32_t>(record); }

void append_film(journal::File& file, int pass, const film::Film& film, std::span<const film::Rect> rects) {
    if (rects.empty()) return;
    std::vector<PixelPart> parts{gather<glm::vec3>(film.pixels(), kColour, film.window(), rects)};
    if (!film.weights().empty()) parts.push_back(gather<double>(film.weights(), kWeight, film.window(), rects));
    const auto payload = journal::pixel_record({static_cast<std::uint32_t>(pass), {rects.begin(), rects.end()}}, parts);
    const journal::Bytes bytes(payload);
    file.append(type_of(JournalRecord::pixels), {&bytes, 1});
}

// Strip by strip, so that little memory is taken for it.
template <class Append>
void for_each_strip(const film::StripLayout& layout, const Append& append) {
    for (int i = 0; i < layout.count(); ++i) {
        const film::Rect strip = layout.strip(i);
        append(std::span(&strip, 1));
    }
}

struct PassNumbers {
    std::int32_t passes, pairs, predicted_passes;  // the last -1: none
    std::int32_t is_weighted;
    double mean, squares, longest_pass_s, predicted_seconds;
};

PassNumbers numbers_of(const strata::render::PassesSoFar& so_far) {
    const strata::render::ErrorMeter::State& meter = so_far.meter.state();
    return {so_far.passes,
            meter.pairs,
            so_far.predicted_passes.value_or(-1),
            so_far.sum.weighted() ? 1 : 0,
            meter.mean,
            meter.squares,
            so_far.longest_pass_s,
            so_far.predicted_seconds};
}

void append_sums(journal::File& file, const strata::render::PassesSoFar& so_far, const film::StripLayout& layout) {
    journal::PayloadWriter numbers;
    numbers.put(numbers_of(so_far));
    const journal::Bytes bytes = numbers.bytes();
    file.append(type_of(JournalRecord::passes), {&bytes, 1});
    if (so_far.sum.passes() == 0) return;
    const std::vector<glm::vec4>& moments = so_far.meter.state().moments;
    for_each_strip(layout, [&](std::span<const film::Rect> strip) {
        std::vector<PixelPart> parts{gather(so_far.sum.sums(), kSums, layout.window, strip)};
        if (so_far.sum.weighted()) parts.push_back(gather(so_far.sum.weights(), kWeight, layout.window, strip));
        if (!moments.empty()) parts.push_back(gather<glm::vec4>(moments, kMoments, layout.window, strip));
        const auto payload = journal::pixel_record({0, {strip.begin(), strip.end()}}, parts);
        const journal::Bytes record(payload);
        file.append(type_of(JournalRecord::sums), {&record, 1});
    });
}

[[noreturn]] void fail() { throw journal::JournalError("a record of the journal holds other numbers than it should"); }

void check_parts(const std::vector<PixelPart>& parts, std::initializer_list<SampleLayout> expected) {
    if (!std::ranges::equal(parts, expected, {}, &PixelPart::layout)) fail();
}

}  // namespace

PassJournal::PassJournal(WorkJournal& journal, const film::Rect& window)
    : journal_(journal), layout_{window, image::kStripRows}, kept_(layout_) {}

void PassJournal::restore_strip(const journal::KeptPixels& kept, film::Film& strip) const {
    for (const journal::RecordPlace& place : kept.records_of(layout_.strip_at(strip.window().y0))) {
        const auto [head, parts] = journal::read_pixel_record(journal_.file().read(place));
        const bool has_weights = !strip.weights().empty();
        has_weights ? check_parts(parts, {kColour, kWeight}) : check_parts(parts, {kColour});
        const auto* colour = reinterpret_cast<const float*>(parts[0].samples.data());
        const unsigned char* weights = has_weights ? parts[1].samples.data() : nullptr;
        journal::for_each_pixel(head.rects, [&](int x, int y, std::size_t i) {
            if (y < strip.window().y0 || y >= strip.window().y1) return;  // of another strip
            strip.finish(x, y, {colour[3 * i], colour[3 * i + 1], colour[3 * i + 2]});
            if (weights == nullptr) return;
            double weight;
            std::memcpy(&weight, weights + i * sizeof weight, sizeof weight);
            strip.set_weight(x, y, weight);
        });
    }
}

bool PassJournal::restore_last(film::Film& film) const {
    journal::KeptPixels kept(layout_);
    journal_.find_pixels(kept_passes_ - 1, kept);
    for (int i = 0; i < layout_.count(); ++i) {
        film::Film strip(layout_.strip(i), {.weights = !film.weights().empty()});
        restore_strip(kept, strip);
        film.paste(strip);
    }
    return film.complete();
}

std::optional<strata::render::PassesSoFar> PassJournal::restore_sums(const film::FilmExtras& extras) const {
    std::optional<PassNumbers> numbers;
    std::vector<glm::dvec3> sums;
    std::vector<double> weights;
    std::vector<glm::vec4> moments;
    const std::size_t pixels = std::size_t(layout_.window.width()) * std::size_t(layout_.window.height());
    std::size_t found = 0;
    for (const journal::RecordPlace& place : journal_.file().places()) {
        if (place.type == type_of(JournalRecord::passes)) {
            const std::vector<unsigned char> payload = journal_.file().read(place);
            numbers = journal::PayloadReader(payload).take<PassNumbers>();
            if (numbers->passes < 2) break;
            sums.resize(pixels);
            if (numbers->is_weighted != 0) weights.resize(pixels);
            if (numbers->is_weighted != 0 && numbers->pairs > 0) moments.resize(pixels);
        }
        if (place.type != type_of(JournalRecord::sums) || !numbers) continue;
        const auto [head, parts] = journal::read_pixel_record(journal_.file().read(place));
        if (!moments.empty())
            check_parts(parts, {kSums, kWeight, kMoments});
        else if (!weights.empty())
            check_parts(parts, {kSums, kWeight});
        else
            check_parts(parts, {kSums});
        for (const film::Rect& rect : head.rects) {
            const film::Rect& w = layout_.window;
            if (rect.x0 < w.x0 || rect.y0 < w.y0 || rect.x1 > w.x1 || rect.y1 > w.y1) fail();
        }
        scatter<glm::dvec3>(parts[0], sums, layout_.window, head.rects);
        if (!weights.empty()) scatter<double>(parts[1], weights, layout_.window, head.rects);
        if (!moments.empty()) scatter<glm::vec4>(parts[2], moments, layout_.window, head.rects);
        found += head.pixels();
    }
    // The journal takes its name when all sums are in it: what is missing was damaged later.
    if (!numbers || (numbers->passes >= 2 && found != pixels)) return std::nullopt;
    if ((numbers->is_weighted != 0) != extras.weights && numbers->passes >= 2) return std::nullopt;
    strata::render::PassesSoFar so_far;
    so_far.passes = numbers->passes;
    if (numbers->passes >= 2)
        so_far.sum = strata::render::PassSum(numbers->passes, std::move(sums), std::move(weights));
    so_far.meter = strata::render::ErrorMeter({numbers->pairs, numbers->mean, numbers->squares, std::move(moments)});
    so_far.longest_pass_s = numbers->longest_pass_s;
    if (numbers->predicted_passes >= 0) so_far.predicted_passes = numbers->predicted_passes;
    so_far.predicted_seconds = numbers->predicted_seconds;
    return so_far;
}

std::optional<strata::render::PassesSoFar> PassJournal::restore(const film::Rect& window,
                                                                const film::FilmExtras& extras) {
    if (!journal_.is_resumed()) return std::nullopt;
    std::optional<strata::render::PassesSoFar> so_far = restore_sums(extras);
    if (so_far) {
        kept_passes_ = so_far->passes;
        if (so_far->passes % 2 == 1) {
            so_far->last = film::Film(window, extras);
            if (!restore_last(so_far->last)) so_far.reset();
        }
    }
    if (!so_far) {
        kept_passes_ = 0;
        return std::nullopt;
    }
    so_far->seconds = journal_.earlier_seconds();
    written_passes_ = kept_passes_;
    journal_.find_pixels(kept_passes_, kept_);
    return so_far;
}

void PassJournal::begin_pass(const strata::render::PassesSoFar& before, const film::Film& pass) {
    before_ = &before;
    number_ = before.passes;
    pass_ = &pass;
    pending_.clear();
}

bool PassJournal::has(const film::Rect& part) const { return before_->passes == kept_passes_ && kept_.has(part); }

void PassJournal::leaving(film::Film& strip, std::span<const film::Rect> fresh) {
    if (before_->passes == kept_passes_ && kept_.pixels() > 0) restore_strip(kept_, strip);
    pending_.insert(pending_.end(), fresh.begin(), fresh.end());
}

void PassJournal::keep(std::span<const film::InWork> in_work) {
    const double start_s = parallel::thread_cpu_seconds();
    const auto append_new = [&](journal::File& file) {
        append_film(file, before_->passes, *pass_, pending_);
        for (const film::InWork& work : in_work) append_film(file, before_->passes, *work.film, work.fresh);
        pending_.clear();
    };
    if (written_passes_ == before_->passes) {
        journal_.change(append_new);
    } else {
        journal_.replace([&](journal::File& file) {
            append_sums(file, *before_, layout_);
            if (before_->passes % 2 == 1) {
                for_each_strip(layout_, [&](std::span<const film::Rect> strip) {
                    append_film(file, before_->passes - 1, before_->last, strip);
                });
            }
            append_new(file);
        });
        written_passes_ = before_->passes;
    }
    journal_.sync(parallel::thread_cpu_seconds() - start_s);
}

void PassJournal::stop() {
    // A pass that is whole is in the sums.
    if (before_->passes != number_) pending_.clear();
    if (journal_.is_open()) keep({});
}

}  // namespace strata::tools::job
