#include "src/scene/rate.h"

#include <fmt/format.h>

#include <charconv>
#include <numeric>

#include "src/scene/key_text.h"

namespace strata::scene {

namespace {

std::optional<long long> whole_number(std::string_view text) {
    long long value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || rest != text.data() + text.size()) return std::nullopt;
    if (value < 1 || value > kMostOfFraction) return std::nullopt;
    return value;
}

}  // namespace

Rate Rate::fraction(long long numerator, long long denominator) {
    const long long common = std::gcd(numerator, denominator);
    const long long reduced_numerator = numerator / common, reduced_denominator = denominator / common;
    Rate rate(static_cast<double>(reduced_numerator));
    rate.denominator_ = static_cast<double>(reduced_denominator);
    return rate;
}

Rate Rate::every(int step) const {
    Rate rate(*this);
    rate.denominator_ *= step;
    return rate;
}

std::string Rate::text() const {
    if (denominator_ == 1.0) return number_text(numerator_);
    if (numerator_ != static_cast<double>(static_cast<long long>(numerator_))) return number_text(*this);
    return fmt::format("{:.0f}/{:.0f}", numerator_, denominator_);
}

std::optional<Rate> parse_fraction(std::string_view text) {
    const auto slash = text.find('/');
    if (slash == std::string_view::npos) return std::nullopt;
    const auto numerator = whole_number(text.substr(0, slash)), denominator = whole_number(text.substr(slash + 1));
    if (!numerator || !denominator) return std::nullopt;
    return Rate::fraction(*numerator, *denominator);
}

}  // namespace strata::scene
