// A solid is f(x) <= 0 with f(x) = value(x) - relief: a base shape, given by the sign of value(), displaced by noise.
// The kinds are a closed list (all.h), a file each; this file is what is read from that list.
//
// A kind is a small struct of its own keys, in the surface's coordinates, with:
//
//   kName, kMeaning    its name in scene files, and its equation in a few words; the sum is the relief's
//   kDimensions        of the noise: 2 (over a plane alone, at its x and z) or 3
//   kSteepest          the Lipschitz constant of value(), at most 1
//   kIsLevel           whether up() is +y everywhere
//   keys(to)           tells its keys to `to` (src/scene/key_list.h); their names are its own among all kinds
//   value, gradient    of the base. Along every ray value() is linear or convex: the tracers take its tangent as a
//                      lower bound
//   half_curvature     bound of half the second derivative of value() along any ray down to where all is solid;
//   infinite:
//                      there is none
//   height, up         what materials call height, and up, of unit length
//   clip               the part of a ray of unit direction outside of which f > 0; amplitude bounds |relief|
//   extent             what holds all that is solid
//   reach              how far from the origin its noise is seen at most, of rays that come so far; kReachKey names the
//                      key that bounds it, where one does
//   bound_normal       only where clip() tells that rays enter a bound: its outward normal
//
// and below the struct, for vectors of points, base_of (value, and its derivative along a direction) and gradient_of,
// as templates over the SolidLanes of src/trace/base-inl.h.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include "src/solid/all.h"

namespace strata::solid {

template <class S>
concept Shape = requires(const S& s, const glm::dvec3& x, double length) {
    { S::kName } -> std::convertible_to<std::string_view>;
    { S::kMeaning } -> std::convertible_to<std::string_view>;
    requires S::kDimensions == 2 || S::kDimensions == 3;
    requires S::kSteepest >= 0.0 && S::kSteepest <= 1.0;
    { S::kIsLevel } -> std::convertible_to<bool>;
    { s.value(x) } -> std::same_as<double>;
    { s.gradient(x) } -> std::same_as<glm::dvec3>;
    { s.half_curvature(length) } -> std::same_as<double>;
    { s.height(x) } -> std::same_as<double>;
    { s.up(x) } -> std::same_as<glm::dvec3>;
    { s.clip(x, x, length, length) } -> std::same_as<Interval>;
    { s.extent(length) } -> std::same_as<Extent>;
    { s.reach(length) } -> std::same_as<double>;
};

// Whether a body cuts it out of space, whose surface is part of its own.
template <class S>
inline constexpr bool kHasBound = requires(const S& s, const glm::dvec3& x) {
    s.bound_normal(x);
};

namespace detail {

template <class List>
struct Of;

template <class... S>
struct Of<std::variant<S...>> {
    static_assert((Shape<S> && ...));
    using Each = std::tuple<S...>;

    template <class T>
    static constexpr std::size_t index = [] {
        std::size_t i = 0;
        const bool found = ((std::same_as<S, T> || (++i, false)) || ...);
        return found ? i : throw "not in the list of solids";
    }();
};

}  // namespace detail

inline constexpr std::size_t kKinds = std::variant_size_v<Solid>;

// A kind of solid by its place in the list. There are no enumerators to switch over: what differs from kind to kind is
// asked of the kinds.
enum class Kind : std::uint8_t {};

template <class S>
inline constexpr Kind kKind{detail::Of<Solid>::index<S>};

// One of each kind: a scene keeps the keys of all while its kind changes.
using Solids = detail::Of<Solid>::Each;

// What `f` makes of the solid, as its own type.
template <std::size_t I = 0, class F>
constexpr decltype(auto) visit(const F& f, const Solid& solid) {
    if constexpr (I + 1 < kKinds) {
        if (solid.index() != I) return visit<I + 1>(f, solid);
    }
    return f(*std::get_if<I>(&solid));
}

template <std::size_t I = 0>
constexpr Solid pick(const Solids& solids, Kind kind) {
    if constexpr (I + 1 < kKinds) {
        if (static_cast<std::size_t>(kind) != I) return pick<I + 1>(solids, kind);
    }
    return std::get<I>(solids);
}

// A row of the table of all kinds.
struct KindRow {
    Kind kind;
    std::string_view name;
    std::string_view meaning;
    int dimensions;  // of its noise
    bool is_level;
    bool has_bound;
    std::string_view reach_key;  // the key that bounds how far its noise is seen; empty: none does
};

namespace detail {

template <class S>
constexpr KindRow row_of() {
    std::string_view reach_key;
    if constexpr (requires { S::kReachKey; }) reach_key = S::kReachKey;
    return {kKind<S>, S::kName, S::kMeaning, S::kDimensions, S::kIsLevel, kHasBound<S>, reach_key};
}

template <class... S>
constexpr std::array<KindRow, sizeof...(S)> rows_of(const std::variant<S...>*) {
    return {row_of<S>()...};
}

inline constexpr auto kRows = rows_of(static_cast<const Solid*>(nullptr));

}  // namespace detail

constexpr std::span<const KindRow> all_solids() { return detail::kRows; }

constexpr const KindRow& row_of(Kind kind) { return detail::kRows[static_cast<std::size_t>(kind)]; }

// The point over or under x where value() is `height`, along the gradient at x: exact for planes and spheres. x itself
// where the base has no gradient.
inline glm::dvec3 over(const Solid& solid, const glm::dvec3& x, double height) {
    return visit([&](const auto& s) { return x + (height - s.value(x)) * s.gradient(x); }, solid);
}

}  // namespace strata::solid
