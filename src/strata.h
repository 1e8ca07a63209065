// Strata as a library: procedural implicit surfaces, ray cast and antialiased with stratified B-spline samples (Gamito
// & Maddock, "Anti-aliasing with stratified B-spline filters of arbitrary degree", CGF 25(2), 2006).
//
// Installed as <strata/strata.h>; link Strata::strata. Noise alone is in <strata/noise.h>, Strata::noise.
//
//     strata::Scene scene = strata::Scene::builtin("terrain");
//     scene.set("film.width", 640);
//     strata::render_file(scene, "terrain.exr");
//
// World: right-handed, y up; lengths are world units, times seconds, angles degrees. Screen: pixel (0,0) is top left,
// its centre at (0.5, 0.5); u runs right, v down. Radiance is linear, in the primaries of sRGB, without a bound above.
//
// A picture depends on the scene, the passes and the SIMD target (<strata/noise.h>) alone, to the last bit: not on
// threads, tiles or windows. It is the picture that `strata render` makes of the same scene.
//
// Whatever is refused or fails is a strata::Error (error.h), and nothing has been written then: an earlier file of that
// name stays. Functions may be called from several threads at once, also with one object, as long as none of the calls
// changes it. Process-wide effects: while a render runs, TBB may start as many threads as it was asked for; the first
// file sets OpenImageIO's attributes "threads" to 1 and "debug" to 0. No signal is handled and nothing is printed.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "error.h"

namespace strata {

using Vector = std::array<double, 3>;  // x, y, z

// A key of a scene, as `strata scenes NAME` explains it.
struct Key {
    std::string name;     // "camera.fov_deg"
    std::string value;    // the present one, as TOML
    std::string allowed;  // "0.01 to 179 degrees"
    std::string meaning;
    bool matters = true;  // false: this kind of picture or surface ignores it
};

// What a picture is made of: a value for each of some 70 keys.
class Scene {
  public:
    struct Data;  // the library's own

    // Every key at its default: a terrain.
    Scene();
    ~Scene();
    Scene(const Scene& other);
    Scene& operator=(const Scene& other);
    Scene(Scene&& other) noexcept;
    Scene& operator=(Scene&& other) noexcept;

    // A scene that comes with Strata: one of builtin_names(), a to z.
    static Scene builtin(std::string_view name);
    static std::vector<std::string> builtin_names();

    // A scene file (TOML), or the scene of a picture that Strata wrote, whatever its format; of a picture, only the
    // scene: not its crop or number of passes.
    static Scene load(const std::filesystem::path& file);

    // The text of a scene file. `source` stands in front of messages.
    static Scene parse(std::string_view toml, std::string_view source = "scene");

    // Sets one key, "section.name", or "relief.TERM.name" of a term that the scene has: TOML alone adds terms. Text is
    // TOML, but words need no quotes: set("sampling.estimator", "sobol"). Counts and seeds take whole numbers only.
    // What one key can tell is checked here, what several tell together by check(); on Error the scene is as before.
    void set(std::string_view key, std::string_view value);
    void set(std::string_view key, const char* value) { set(key, std::string_view(value)); }
    void set(std::string_view key, const Vector& value);
    template <class Number>
    requires std::is_arithmetic_v<Number>
    void set(std::string_view key, Number value) {
        if constexpr (std::is_same_v<Number, bool>) {
            set(key, value ? "true" : "false");
        } else if constexpr (std::is_integral_v<Number>) {
            set(key, std::string_view(std::to_string(value)));
        } else {
            set_number(key, static_cast<double>(value));
        }
    }

    // The value of a key as TOML, which set() takes back to the bit.
    std::string get(std::string_view key) const;

    // All keys, in the order of a scene file.
    std::vector<Key> keys() const;

    // The whole scene as a scene file, every key explained. parse() gives the same scene to the bit.
    std::string toml() const;

    // Throws Error for a scene that cannot be rendered. Rendering and probing check by themselves.
    void check() const;

    int width() const;   // of the frame, pixels
    int height() const;  // likewise

  private:
    friend const Data& data_of(const Scene& scene);

    void set_number(std::string_view key, double value);

    std::unique_ptr<Data> data_;
};

// Half-open: pixels [x0,x1) x [y0,y1) of the frame.
struct Window {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    bool operator==(const Window&) const = default;
};

enum class Tracer {
    fast,
    reference  // plain sphere tracing in double: some 200 times as slow, keeps the same promises by less code
};

struct Progress {
    double fraction = 0;                        // of the work, [0,1]
    std::uint64_t rays = 0;                     // so far, without shadow rays
    std::chrono::duration<double> elapsed{0};   // since the start
    std::chrono::duration<double> expected{0};  // of the whole, as it looks now; 0: unknown
};

struct RenderOptions {
    // Not empty, inside the frame; none: the whole frame. A window equals the same pixels of the frame.
    std::optional<Window> window{};

    Tracer tracer = Tracer::fast;

    // Independent passes of N x N samples a pixel, averaged, 1 to 1,000,000. None: one, or with either goal below as
    // many as it takes. Estimators "none", "super" and "uniform", whose passes are all alike, allow one.
    std::optional<int> passes{};

    // Until the error of linear radiance, noise and bias, is at most this RMSE with 95 % confidence, four passes at
    // least; 1e-9 to 1e6, 0: no goal.
    double target_rmse = 0;

    // No pass that is predicted to end later than this after the start; the first always is done. >= 0, 0: no limit.
    std::chrono::duration<double> time_limit{0};

    int threads = 0;  // 0 to 1024; 0: as many as machine, affinity and container give. Fewer where none can be started
    int tile = 32;    // side in pixels, 1 to 1024: a unit of work

    // Called some ten times a second at most, from any thread, never twice at once. What it throws ends the render and
    // is thrown by it.
    std::function<void(const Progress&)> on_progress{};

    // Ends the render soon after a stop is requested, which on_progress may do.
    std::stop_token stop{};
};

// What a render did. Counts do not depend on threads; evaluations and steps vary a little with tiles and windows, whose
// rays share work.
struct RenderReport {
    bool is_complete = false;  // false: stopped before its goals were reached
    int passes = 0;            // whole ones
    std::int64_t finished_pixels = 0;
    std::uint64_t rays = 0;  // samples of the picture
    std::uint64_t shadow_rays = 0;
    std::uint64_t sky_rays = 0;    // where sky.light is "rays"
    std::uint64_t water_rays = 0;  // mirrored and refracted by water
    std::uint64_t hits = 0;
    std::uint64_t unresolved_rays = 0;  // not settled within the step limit: drawn in magenta, or as shadow
    std::uint64_t noise_evaluations = 0;
    std::uint64_t steps = 0;
    int threads = 0;                            // used
    std::chrono::duration<double> elapsed{0};   // tracing, shading, filtering; not set-up
    std::chrono::duration<double> cpu_time{0};  // of all threads
    std::optional<double> noise_rmse{};         // error of linear radiance, told from passes: from two on
};

// Linear RGB of a window of a frame: rows from the top, three floats a pixel.
struct Image {
    int frame_width = 0, frame_height = 0;
    Window window;
    std::vector<float> rgb;  // 3 * width() * height() of the window

    int width() const { return window.width(); }
    int height() const { return window.height(); }

    // By the pixel's coordinates in the frame, inside the window: r, g, b.
    std::array<float, 3> at(int x, int y) const {
        const std::size_t i = 3 * (static_cast<std::size_t>(y - window.y0) * static_cast<std::size_t>(width()) +
                                   static_cast<std::size_t>(x - window.x0));
        return {rgb[i], rgb[i + 1], rgb[i + 2]};
    }
};

struct RenderedImage {
    Image image;  // of a stopped render: the mean of whole passes, or black where the first was not finished
    RenderReport report;
};

RenderedImage render_image(const Scene& scene, const RenderOptions& options = {});

enum class ExrFormat { half, single };

struct FileOptions {
    ExrFormat exr_format = ExrFormat::half;
    bool tiled = false;  // EXR in tiles of 64 x 64, as from 4096 pixels on either side without being asked
};

// Renders into a file, by its extension .exr (linear), .png, .tif, .tiff, .jpg or .jpeg (with the scene's exposure,
// tone curve and the like, and the sRGB curve): the same bytes as `strata render -o FILE`. One pass is written while it
// is rendered, so that memory does not grow with the height. The file appears whole when all is done; of a stopped
// render nothing is written.
RenderReport render_file(const Scene& scene, const std::filesystem::path& file, const RenderOptions& options = {},
                         const FileOptions& file_options = {});

// The surface at a point: f <= 0 is inside.
struct FieldValue {
    double f = 0;                 // in surface units, before the intersection with an isosurface's bound
    Vector gradient{};            // of f, by world position
    std::vector<double> octaves;  // f = base - their sum
};

enum class Outcome { hit, miss, unresolved };

struct RayResult {
    Vector origin{}, direction{};  // of the ray, in the world; direction has unit length
    Outcome outcome = Outcome::miss;
    double distance = 0;  // to the hit, world units: within the scene's tolerance of it lies a point with f <= 0
    Vector position{};    // of the hit, in the world
    Vector normal{};      // outward, of unit length
    std::uint32_t steps = 0;
    std::uint32_t noise_evaluations = 0;  // without the normal's
};

// Asks for single points and rays of a scene whose key `image` is "surface". Reads the scene once. Times are seconds;
// none: the middle of the frame's shutter.
class Probe {
  public:
    explicit Probe(const Scene& scene, Tracer tracer = Tracer::fast);
    ~Probe();
    Probe(Probe&& other) noexcept;
    Probe& operator=(Probe&& other) noexcept;

    // In double, from the reference path. Error for a point so far from surface.origin that double does not tell the
    // finest octave's cells apart.
    FieldValue field(const Vector& position, std::optional<double> time = {}) const;

    // From `origin` along `direction`, of any length but zero, as far as camera.far, with the tolerance that the centre
    // of the screen has. A ray that starts inside hits at distance 0. Error for what is too far away, as in field().
    RayResult ray(const Vector& origin, const Vector& direction, std::optional<double> time = {}) const;

    // The camera's ray through a point of the frame, in pixels: (0.5, 0.5) is the centre of the first.
    RayResult screen_ray(double u, double v, std::optional<double> time = {}) const;

  private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace strata
