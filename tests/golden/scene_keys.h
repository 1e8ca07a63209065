// What the golden scenes are put together from: keys over the defaults, and lists of terms and of layers.
#pragma once

#include <string>
#include <vector>

namespace strata::golden {

using Keys = std::vector<std::string>;

inline Keys operator+(Keys keys, const Keys& more) {
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
}

inline const Keys kSurface{"film.width=36", "film.height=20", "sampling.N=2", "sun.intensity=4"};

inline const Keys kTerrain =
    kSurface + Keys{"surface.kind=terrain", "surface.amplitude=1.5",          "surface.frequency=0.2",
                    "surface.gain=0.47",    "camera.position=[0,1.2,0]",      "camera.look_at=[1,0.75,6]",
                    "camera.far=200",       "sun.direction=[-0.8,0.42,0.35]", "sky.haze_distance=60"};

inline const Keys kHyperterrain =
    kSurface + Keys{"surface.kind=hyperterrain", "camera.position=[0.3,0.9,0.1]", "camera.look_at=[0.3,0.75,1.1]",
                    "camera.far=60", "sun.direction=[0.6,0.5,-0.3]"};

inline const Keys kPlanet =
    kSurface + Keys{"surface.kind=planet",      "surface.radius=2", "surface.amplitude=0.3",
                    "surface.frequency=1.2",    "surface.seed=3",   "camera.position=[0.5,1,-6]",
                    "camera.look_at=[0,0,0]",   "camera.far=30",    "sun.direction=[-7,3.5,1]",
                    "material.band_height=0.05"};

inline const Keys kIsosurface =
    kSurface + Keys{"surface.kind=isosurface", "surface.threshold=0.2",        "surface.bound_size=[1.6,1.6,1.6]",
                    "surface.amplitude=1",     "surface.frequency=1.7",        "surface.gain=0.45",
                    "surface.seed=9",          "camera.position=[0,2,-5]",     "camera.look_at=[0,0,0]",
                    "camera.far=20",           "sun.direction=[-0.5,0.8,-0.6]"};

inline const std::vector<std::string> kCosts{"steps", "evals"};
inline const std::vector<std::string> kGeometry{"Z", "depth", "P", "N", "motion", "samples"};
inline const std::vector<std::string> kLight{"albedo", "sun", "sky", "air", "background", "shadow", "height", "slope"};
inline const Keys kOneOctave{"surface.octaves=1"};
inline const Keys kSixteenOctaves{"surface.octaves=16", "sampling.N=1"};
inline const Keys kNoShadows{"sun.shadows=false"};
inline const Keys kStratified{"sampling.estimator=stratified"};
inline const Keys kShutter{"shutter.open_s=0.03", "shutter.frame=7"};

// A ridge, and the same bent.
inline const std::string kCrests = R"([[relief]]
name = "crests"
type = "ridged"
octaves = 4
frequency = 0.3
seed = 7
[[relief]]
name = "bent"
type = "warp"
of = ["crests"]
amplitude = 0.5
)";

inline const std::string kLandform = kCrests + R"([[relief]]
name = "massif"
type = "envelope"
of = ["bent"]
z = 5.0
[[relief]]
name = "level"
type = "fill"
of = ["massif"]
[[relief]]
name = "carved"
type = "gullies"
of = ["level", "crests"]
octaves = 2
[[relief]]
name = "rough"
type = "fbm"
octaves = 4
amplitude = 0.03
frequency = 2.0
[[relief]]
name = "all"
type = "sum"
of = ["carved", "rough"]
)";

inline const std::string kShapes = R"([[relief]]
name = "hills"
type = "hybrid"
octaves = 3
turn_deg = 30.0
[[relief]]
name = "cushions"
type = "billow"
octaves = 3
amplitude = 0.4
[[relief]]
name = "stepped"
type = "terraces"
of = ["hills"]
[[relief]]
name = "cliffs"
type = "curve"
of = ["stepped"]
[[relief]]
name = "higher"
type = "highest"
of = ["cliffs", "cushions"]
[[relief]]
name = "mixed"
type = "blend"
of = ["higher", "hills", "cushions"]
from = 0.1
to = 0.2
[[relief]]
name = "cut"
type = "lowest"
of = ["mixed", "hills"]
[[relief]]
name = "weighed"
type = "product"
of = ["cut", "cushions"]
)";

inline const std::string kPlaces = kShapes + R"([[relief]]
name = "dunes"
type = "dunes"
[[relief]]
name = "craters"
type = "craters"
octaves = 3
[[relief]]
name = "far"
type = "ramp"
height = 0.5
[[relief]]
name = "all"
type = "sum"
of = ["weighed", "dunes", "craters", "far"]
)";

// Layers of ground: every kind of mask.
inline const std::string kGround = R"([[ground]]
name = "rock"
kind = "granite"
tone = 0.8
tone_size = 0.7
tone_stretch = 0.5
[[ground]]
name = "beds"
kind = "red_sandstone"
strata_from = 0.0
strata_thickness = 0.2
strata_warp = 0.1
[[ground]]
name = "grass"
kind = "grass"
cover = 0.9
slope_to_deg = 30.0
slope_noise_deg = 5.0
noise_from = -0.5
[[ground]]
name = "snow"
kind = "fresh_snow"
height_from = 0.4
height_noise = 0.1
aspect = [0.8, 0.0, -0.35]
facing_from = -0.1
noise_size = 0.5
)";

}  // namespace strata::golden
