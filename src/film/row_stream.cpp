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
                     StripSink sink)
    : layout_(layout), most_open_(most_open), extras_(extras), sink_(std::move(sink)), parts_left_(std::move(parts)) {}

Film& RowStream::open(int number) {
    std::unique_lock lock(mutex_);
    gone_.wait(lock, [&] { return number < next_ + most_open_; });
    const auto [entry, is_new] = open_.try_emplace(number);
    if (is_new) {
        entry->second = Film(layout_.strip(number), extras_);
        hold(entry->second);
    }
    return entry->second;
}

void RowStream::set_aside(int number, Film film) {
    const std::lock_guard lock(mutex_);
    hold(film);
    aside_.emplace(number, std::move(film));
}

double RowStream::end_part(int number) {
    std::unique_lock lock(mutex_);
    --parts_left_[static_cast<std::size_t>(number)];
    // Whoever gives away goes on with what others complete meanwhile.
    if (is_giving_ || parts_left_[static_cast<std::size_t>(next_)] > 0) return 0.0;
    const double start_s = parallel::thread_cpu_seconds();
    is_giving_ = true;
    while (next_ < layout_.count() && parts_left_[static_cast<std::size_t>(next_)] == 0) {
        lock.unlock();
        give_away(next_);
        lock.lock();
        ++next_;
        gone_.notify_all();
    }
    is_giving_ = false;
    return parallel::thread_cpu_seconds() - start_s;
}

void RowStream::give_away(int number) {
    Film film = std::move(open(number));
    std::unique_lock lock(mutex_);
    const auto [begin, end] = aside_.equal_range(number);
    for (auto part = begin; part != end; ++part) {
        film.paste(part->second);
        release(part->second);
    }
    aside_.erase(begin, end);
    finished_pixels_ += static_cast<std::int64_t>(film.finished_count());
    const bool is_wanted = !failure_;
    lock.unlock();
    std::exception_ptr failure;
    try {
        if (is_wanted) sink_(film);
    } catch (...) {
        failure = std::current_exception();
    }
    lock.lock();
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
