// A film of which only the strips in work are held: finished ones go, in order, to where they are wanted.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <vector>

#include "src/film/film.h"
#include "src/film/row_keeper.h"

namespace strata::film {

// Is given a picture's strips one after the other from the top, by one thread at a time, a film of the strip's window
// each. Pixels that a cancelled render left out are not finished, and black.
using StripSink = std::function<void(const Film& strip)>;

// A window cut into strips of `rows` rows, the last of which may have fewer.
struct StripLayout {
    Rect window;
    int rows = 1;

    int count() const { return (window.height() + rows - 1) / rows; }
    int strip_at(int y) const { return (y - window.y0) / rows; }
    Rect strip(int number) const;
};

// Each strip is worked on in a number of parts, by any threads. Parts are begun in the order of the strips, but for
// those that are set aside, and every part is ended, finished or not.
class RowStream {
  public:
    // parts: of each strip. At most `most_open` strips are held at once, beside what is set aside. `keeper` may be
    // null: none.
    RowStream(const StripLayout& layout, std::vector<int> parts, int most_open, const FilmExtras& extras,
              StripSink sink, RowKeeper* keeper = nullptr);

    const StripLayout& layout() const { return layout_; }

    // The film of a strip, which has parts to be ended; waits until strips before it are gone.
    Film& open(int number);

    // Sets a film aside, to be put into the strip when it is whole.
    void set_aside(int number, Film film);

    // A rectangle of a strip that is open has been finished, for the keeper.
    void note_finished(int number, const Rect& part);

    // Ends a part, gives away all strips that are whole and next, and hands over to the keeper what is due; returns the
    // CPU time that this took.
    double end_part(int number);

    // The last of the three alone.
    double keep_if_due();

    // When all parts are ended: throws what the sink threw, after which it was not called any more.
    void check() const;
    std::int64_t finished_pixels() const { return finished_pixels_; }
    std::size_t most_bytes() const { return most_bytes_; }  // of films held at once

  private:
    struct Strip {
        Film film;
        std::vector<Rect> fresh;  // finished, and not handed over to the keeper
    };
    struct Aside {
        Film film;
        bool is_fresh = true;
    };

    double give_and_keep(std::unique_lock<std::mutex> lock);
    void give_away(int number);
    void keep_in_work(std::unique_lock<std::mutex>& lock);
    Strip& open_strip(std::unique_lock<std::mutex>& lock, int number);
    void hold(const Film& film);
    void release(const Film& film);

    StripLayout layout_;
    int most_open_;
    FilmExtras extras_;
    StripSink sink_;
    RowKeeper* keeper_;

    mutable std::mutex mutex_;  // guards all below; not held while a sink is at work
    std::condition_variable gone_;
    std::map<int, Strip> open_;
    std::multimap<int, Aside> aside_;
    std::vector<int> parts_left_;
    int next_ = 0;            // to be given away
    bool is_giving_ = false;  // a thread is: it alone takes films away, and talks to the keeper
    std::exception_ptr failure_;
    std::int64_t finished_pixels_ = 0;
    std::size_t bytes_ = 0, most_bytes_ = 0;
};

}  // namespace strata::film
