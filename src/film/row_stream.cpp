#include "src/film/row_stream.h"

#include <algorithm>
#include <utility>

#include "src/parallel/cpu_clock.h"

namespace strata::film {

Rect StripLayout::strip(int number) const {
    const int y0 = window.y0 + number * rows;
    return {window.x0, y0, window.x1, std::min(y0 + rows, window.y1)};
}

RowStream::RowStream(const StripLayout& layout, std::vector<int> parts, int most_open, const FilmExtras& extras,
                     StripSink sink, RowKeeper* keeper)
    : layout_(layout),
      most_open_(most_open),
      extras_(extras),
      sink_(std::move(sink)),
      keeper_(keeper),
      parts_left_(std::move(parts)) {}

Film& RowStream::open(int number) {
    std::unique_lock lock(mutex_);
    return open_strip(lock, number).film;
}

RowStream::Strip& RowStream::open_strip(std::unique_lock<std::mutex>& lock, int number) {
    gone_.wait(lock, [&] { return number < next_ + most_open_; });
    const auto [entry, is_new] = open_.try_emplace(number);
    if (is_new) {
        entry->second.film = Film(layout_.strip(number), extras_);
        hold(entry->second.film);
    }
    return entry->second;
}

void RowStream::set_aside(int number, Film film) {
    const std::lock_guard lock(mutex_);
    hold(film);
    // One that a cancelled render left unfinished is not kept.
    const bool is_whole = keeper_ != nullptr && film.complete();
    aside_.emplace(number, Aside{std::move(film), is_whole});
}

void RowStream::note_finished(int number, const Rect& part) {
    if (keeper_ == nullptr) return;
    const std::lock_guard lock(mutex_);
    open_.at(number).fresh.push_back(part);
}

double RowStream::end_part(int number) {
    std::unique_lock lock(mutex_);
    --parts_left_[static_cast<std::size_t>(number)];
    return give_and_keep(std::move(lock));
}

double RowStream::keep_if_due() { return give_and_keep(std::unique_lock(mutex_)); }

double RowStream::give_and_keep(std::unique_lock<std::mutex> lock) {
    const auto is_next_whole = [&] {
        return next_ < layout_.count() && parts_left_[static_cast<std::size_t>(next_)] == 0;
    };
    bool is_due = keeper_ != nullptr && keeper_->is_due();
    // Whoever gives away goes on with what others complete meanwhile.
    if (is_giving_ || (!is_next_whole() && !is_due)) return 0.0;
    const double start_s = parallel::thread_cpu_seconds();
    is_giving_ = true;
    for (;;) {
        if (is_next_whole()) {
            lock.unlock();
            give_away(next_);
            lock.lock();
            ++next_;
            gone_.notify_all();
        } else if (is_due) {
            is_due = false;
            keep_in_work(lock);
        } else {
            break;
        }
    }
    is_giving_ = false;
    return parallel::thread_cpu_seconds() - start_s;
}

// Films stay where they are while they are handed over: nobody else takes them away, and neither map moves what it
// holds when others are added.
void RowStream::keep_in_work(std::unique_lock<std::mutex>& lock) {
    std::vector<InWork> in_work;
    for (auto& [number, strip] : open_) {
        if (!strip.fresh.empty()) in_work.push_back({&strip.film, std::exchange(strip.fresh, {})});
    }
    for (auto& [number, aside] : aside_) {
        if (std::exchange(aside.is_fresh, false)) in_work.push_back({&aside.film, {aside.film.window()}});
    }
    lock.unlock();
    keeper_->keep(in_work);
    lock.lock();
}

void RowStream::give_away(int number) {
    std::unique_lock lock(mutex_);
    Strip strip = std::move(open_strip(lock, number));
    Film& film = strip.film;
    const auto [begin, end] = aside_.equal_range(number);
    for (auto part = begin; part != end; ++part) {
        film.paste(part->second.film);
        if (part->second.is_fresh) strip.fresh.push_back(part->second.film.window());
        release(part->second.film);
    }
    aside_.erase(begin, end);
    const bool is_wanted = !failure_;
    lock.unlock();
    std::exception_ptr failure;
    try {
        if (keeper_ != nullptr) keeper_->leaving(film, strip.fresh);
        if (is_wanted) sink_(film);
    } catch (...) {
        failure = std::current_exception();
    }
    lock.lock();
    finished_pixels_ += static_cast<std::int64_t>(film.finished_count());
    if (failure) failure_ = failure;
    release(film);
    open_.erase(number);
}

void RowStream::check() const {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
}

void RowStream::hold(const Film& film) {
    bytes_ += film.bytes();
    most_bytes_ = std::max(most_bytes_, bytes_);
}

void RowStream::release(const Film& film) { bytes_ -= film.bytes(); }

}  // namespace strata::film
