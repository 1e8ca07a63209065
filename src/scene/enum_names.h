// The names under which scene files, options and messages know the enumerators of scene.h.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "src/scene/scene.h"

namespace strata::scene {

// kEnumNames<E>[i] names the enumerator of value i.
template <class E>
inline constexpr std::array<std::string_view, 0> kEnumNames{};

template <>
inline constexpr std::array<std::string_view, 7> kEnumNames<ImageKind>{"surface", "zoneplate", "checker", "wheel",
                                                                       "edge",    "ramp",      "constant"};

template <>
inline constexpr auto kEnumNames<solid::Kind> = [] {
    std::array<std::string_view, solid::kKinds> names;
    std::ranges::transform(solid::all_solids(), names.begin(), &solid::KindRow::name);
    return names;
}();

template <>
inline constexpr auto kEnumNames<solid::LevelSet::Bound> = solid::LevelSet::kBounds;

template <>
inline constexpr std::array<std::string_view, 3> kEnumNames<ToneCurve>{"none", "reinhard", "agx"};

template <>
inline constexpr std::array<std::string_view, 2> kEnumNames<Interpolation>{"smooth", "linear"};

template <>
inline constexpr std::array<std::string_view, 2> kEnumNames<SkyModel>{"gradient", "daylight"};

template <>
inline constexpr std::array<std::string_view, 2> kEnumNames<SkyLight>{"open", "rays"};

template <>
inline constexpr auto kEnumNames<EstimatorKind> = [] {
    std::array<std::string_view, all_estimators().size()> names;
    std::ranges::transform(all_estimators(), names.begin(), &EstimatorRow::name);
    return names;
}();

static_assert(static_cast<std::size_t>(ImageKind::constant) + 1 == kEnumNames<ImageKind>.size());
static_assert(static_cast<std::size_t>(solid::LevelSet::Bound::box) + 1 == solid::LevelSet::kBounds.size());
static_assert(static_cast<std::size_t>(ToneCurve::agx) + 1 == kEnumNames<ToneCurve>.size());
static_assert(static_cast<std::size_t>(Interpolation::linear) + 1 == kEnumNames<Interpolation>.size());
static_assert(static_cast<std::size_t>(SkyModel::daylight) + 1 == kEnumNames<SkyModel>.size());
static_assert(static_cast<std::size_t>(SkyLight::rays) + 1 == kEnumNames<SkyLight>.size());

template <class E>
constexpr std::string_view name_of(E value) {
    return kEnumNames<E>[static_cast<std::size_t>(value)];
}

template <class E>
constexpr std::optional<E> from_name(std::string_view name) {
    const auto found = std::find(kEnumNames<E>.begin(), kEnumNames<E>.end(), name);
    if (found == kEnumNames<E>.end()) return std::nullopt;
    return static_cast<E>(found - kEnumNames<E>.begin());
}

}  // namespace strata::scene
