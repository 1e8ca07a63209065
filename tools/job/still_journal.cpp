#include "tools/job/still_journal.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "src/image/samples.h"
#include "src/journal/journal_error.h"
#include "src/parallel/cpu_clock.h"
#include "tools/job/film_channels.h"

namespace strata::tools::job {

StillJournal::StillJournal(WorkJournal& journal, const film::StripLayout& layout, std::vector<SampleKind> kinds,
                           const image::ColourOut& colour)
    : journal_(journal), kept_(layout), kinds_(std::move(kinds)), colour_(colour), codes_(kinds_.size()) {
    if (journal_.is_resumed()) journal_.find_pixels(0, kept_);
}

std::optional<std::size_t> StillJournal::part_of(SampleKind kind) const {
    const auto found = std::ranges::find(kinds_, kind);
    if (found == kinds_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - kinds_.begin());
}

void StillJournal::leaving(film::Film& strip, std::span<const film::Rect> fresh) {
    window_ = strip.window();
    channel_values_ = channel_values(strip);
    fresh_ = journal_.is_open() ? keepable(strip, fresh) : std::vector<film::Rect>();
    restored_.clear();
    for (auto& codes : codes_) codes.clear();
    for (const journal::RecordPlace& place : kept_.records_of(kept_.layout().strip_at(window_.y0))) {
        journal::PixelRecord record = journal::read_pixel_record(journal_.file().read(place));
        if (!has_all_parts(record.parts)) throw journal::JournalError("a record of the journal holds other samples");
        restore(strip, record);
        restored_.push_back(std::move(record));
    }
}

bool StillJournal::has_all_parts(const std::vector<journal::PixelPart>& parts) const {
    if (parts.size() != kinds_.size()) return false;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].layout != layout_of(kinds_[i], channel_values_)) return false;
    }
    return true;
}

void StillJournal::restore(film::Film& strip, const journal::PixelRecord& record) const {
    std::vector<float> colour(3 * record.head.pixels(), 0.0f), channels;
    if (const auto part = part_of(SampleKind::floats)) {
        std::memcpy(colour.data(), record.parts[*part].samples.data(), colour.size() * sizeof(float));
    } else if (const auto halves = part_of(SampleKind::halves)) {
        std::vector<std::uint16_t> bits(colour.size());
        std::memcpy(bits.data(), record.parts[*halves].samples.data(), bits.size() * sizeof(std::uint16_t));
        colour = image::floats(bits);
    }
    if (const auto part = part_of(SampleKind::channels)) {
        channels.resize(channel_values_ * record.head.pixels());
        std::memcpy(channels.data(), record.parts[*part].samples.data(), channels.size() * sizeof(float));
    }
    journal::for_each_pixel(record.head.rects, [&](int x, int y, std::size_t i) {
        strip.finish(x, y, {colour[3 * i], colour[3 * i + 1], colour[3 * i + 2]});
        if (!channels.empty()) set_channels(strip, x, y, &channels[i * channel_values_]);
    });
}

image::CodesHook StillJournal::codes_hook(image::Format format) {
    const std::optional<SampleKind> kind = codes_of(format);
    const std::optional<std::size_t> part = kind ? part_of(*kind) : std::nullopt;
    if (!part || (fresh_.empty() && restored_.empty())) return {};
    return [this, part = *part](std::span<unsigned char> codes) {
        overlay(kinds_[part], codes);
        if (!codes_[part].empty()) return;  // of another output
        const std::size_t pixel = layout_of(kinds_[part], 0).pixel_bytes();
        journal::for_each_row(window_, fresh_, [&](std::size_t in_film, std::size_t, std::size_t pixels) {
            const auto row = codes.subspan(in_film * pixel, pixels * pixel);
            codes_[part].insert(codes_[part].end(), row.begin(), row.end());
        });
    };
}

void StillJournal::overlay(SampleKind kind, std::span<unsigned char> codes) const {
    const std::size_t part = *part_of(kind), pixel = layout_of(kind, 0).pixel_bytes();
    for (const journal::PixelRecord& record : restored_) {
        const unsigned char* samples = record.parts[part].samples.data();
        const auto copy = [&](std::size_t in_film, std::size_t in_record, std::size_t pixels) {
            std::copy_n(samples + in_record * pixel, pixels * pixel,
                        codes.begin() + static_cast<std::ptrdiff_t>(in_film * pixel));
        };
        journal::for_each_row(window_, record.head.rects, copy);
    }
}

void StillJournal::written(const film::Film& strip) {
    restored_.clear();
    if (!fresh_.empty()) append(strip, fresh_, true);
    fresh_.clear();
}

// Encoders that were given up make no codes any more, and a strip that is not finite has none.
void StillJournal::append(const film::Film& film, std::span<const film::Rect> rects, bool use_codes) {
    const journal::PixelHead head{0, {rects.begin(), rects.end()}};
    std::vector<journal::PixelPart> parts;
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
        const journal::SampleLayout layout = layout_of(kinds_[i], channel_values_);
        if (use_codes && codes_[i].size() == head.pixels() * layout.pixel_bytes()) {
            parts.push_back({layout, std::move(codes_[i])});
        } else {
            parts.push_back(samples_of(kinds_[i], film, rects, colour_));
        }
    }
    journal_.append(JournalRecord::pixels, journal::pixel_record(head, parts));
}

void StillJournal::keep(std::span<const film::InWork> in_work) {
    const double start_s = parallel::thread_cpu_seconds();
    journal_.begin();
    for (const film::InWork& work : in_work) {
        channel_values_ = channel_values(*work.film);
        const std::vector<film::Rect> rects = keepable(*work.film, work.fresh);
        if (!rects.empty()) append(*work.film, rects, false);
    }
    journal_.sync(parallel::thread_cpu_seconds() - start_s);
}

void StillJournal::finish() {
    if (journal_.is_open()) journal_.sync(0);
}

}  // namespace strata::tools::job
