// The one description of every key of a scene file: name, field, range, unit, meaning. The reader, the printer, the
// checks and --set all work from it, so a key added here is everywhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "src/scene/scene.h"

namespace strata::scene {

// An enumerated field seen by its names.
struct Choice {
    std::span<const std::string_view> names;
    std::function<std::size_t()> get;      // index into names
    std::function<void(std::size_t)> set;  // likewise
};

// The field of a scene that a key stands for.
using Field = std::variant<bool*, int*, std::uint64_t*, double*, Rate*, glm::dvec3*, std::string*, Choice,
                           std::vector<CameraKey>*, std::vector<std::string>*, std::vector<double>*>;

// Closed, finite. Of a vector: of each component.
struct Range {
    double min = 0.0;
    double max = 0.0;
};

// Of the colours that pictures of 8 and 16 bits are given. White balance can be taken back, so no factor is near 0; a
// lower contrast would not take agx's sigmoid from black to white.
inline constexpr Range kWhiteBalance{0.01, 100.0};
inline constexpr Range kSaturation{0.0, 2.0};
inline constexpr Range kContrast{0.7, 2.0};

// Vectors that name a direction or an axis may have any length from here up; the square of a shorter one nears the
// end of double's range.
inline constexpr double kShortestDirection = 1e-12;

// Seeds are TOML integers, which end here.
inline constexpr std::uint64_t kLargestSeed = 0x7fff'ffff'ffff'ffff;

struct Key {
    std::string section;  // empty at the top of the file
    std::string name;
    Field field;
    Range range;  // int, double, rate and vector fields only
    std::string_view unit;
    std::string_view meaning;
    bool is_direction = false;  // a vector no shorter than kShortestDirection
    bool matters = true;        // false where the scene's kind of picture or surface ignores the key

    // `section.name`, as in --set.
    std::string full_name() const { return section.empty() ? name : section + "." + name; }
};

struct Section {
    std::string name;  // empty: the top of the file
    std::string_view meaning;
    std::vector<Key> keys;
    bool is_term = false;  // one [[relief]], [[ground]] or [[clouds]] of the file, by the name among its keys
};

// The keys of one entry of camera.keys, as section `camera.keys[index]`. The fields point into `entry`; those that it
// leaves out point into `rest`, which is the camera's own.
Section describe_camera_key(CameraKey& entry, Camera& rest, std::size_t index);

// Entries of camera.keys: at most so many, and so far apart in time at least.
inline constexpr std::size_t kMostCameraKeys = 10'000;
inline constexpr double kLeastKeyGap_s = 1e-6;

// Every key, in the order in which it is printed; last the relief's terms and the layers of ground
// and clouds, a section each. The
// fields point into scene, which must outlive them.
std::vector<Section> describe(Scene& scene);

}  // namespace strata::scene
