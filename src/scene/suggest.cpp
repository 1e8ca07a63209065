#include "src/scene/suggest.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace strata::scene {

namespace {

constexpr std::size_t kLongestWord = 200;  // longer words resemble no name, and the distance takes quadratic time

std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

std::size_t allowed_distance(std::size_t length) { return length / 3; }

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    // Rows i-2, i-1 and i of the table of distances between the first i letters of a and the first j of b.
    std::vector<std::size_t> before(b.size() + 1);
    std::vector<std::size_t> last(b.size() + 1);
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;

    for (std::size_t i = 1; i <= a.size(); ++i) {
        before.swap(last);
        last.swap(row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
        }
    }
    return row[b.size()];
}

std::optional<std::string> nearest(std::string_view word, std::span<const std::string> candidates) {
    if (word.empty() || word.size() > kLongestWord) return std::nullopt;
    const std::string wanted = lower_case(word);
    std::optional<std::string> best;
    std::size_t best_distance = 0;
    for (const std::string& candidate : candidates) {
        const std::string name = lower_case(candidate);
        std::size_t distance = edit_distance(wanted, name);
        std::size_t allowed = allowed_distance(std::max(wanted.size(), name.size()));
        // A beginning counts as one slip, so that a closer whole name wins over it.
        if (wanted.size() >= 3 && name.starts_with(wanted)) {
            distance = std::min<std::size_t>(distance, 1);
            allowed = std::max<std::size_t>(allowed, 1);
        }
        if (distance <= allowed && (!best || distance < best_distance)) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

}  // namespace strata::scene
