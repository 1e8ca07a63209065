// What a render of a scene does and what it leaves out, told before it begins.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "noise/relief/certificate.h"
#include "src/integrate/surface_image.h"
#include "src/scene/scene.h"
#include "tools/job/aov.h"

namespace strata::tools::explain {

// Something that a renderer could do.
struct Feature {
    std::string name;
    bool needed = false;
    std::string why;
};

// What an octave does to rays that meet the surface at distances [from, to) from the eye.
struct OctaveRole {
    double from = 0.0, to = 0.0;  // world units
    std::string role;             // "geometry" (hit and normal), "normal", "nothing"
};

struct OctavePlan {
    int octave = 1;              // from 1, coarsest first
    double amplitude = 0.0;      // of f, in surface units
    double wavelength = 0.0;     // side of a lattice cell, world units
    double pixel_wide_at = 0.0;  // distance at which that is a pixel at the frame's centre, world units
    // Distance from which the octave raises or lowers the surface by less than the tolerance of a hit; none for
    // isosurfaces, whose f is no height.
    std::optional<double> below_tolerance_from;
    std::vector<OctaveRole> roles;
};

// A term of a composed relief with its certificate (noise/relief/certificate.h), in surface units.
struct ReliefRow {
    std::string name, type, of;
    std::size_t octaves = 0;  // of its own
    noise::Certificate certificate;
};

struct Plan {
    std::vector<ReliefRow> relief{};
    std::vector<Feature> features;
    std::vector<OctavePlan> octaves;  // none for image-plane patterns
    std::string octaves_note;         // empty for these
};

// Of a valid scene. passes: of N*N samples each, to be averaged.
Plan make_plan(const scene::Scene& scene, integrate::Tracer tracer, int passes = 1,
               const integrate::ChannelSet& aovs = {});

}  // namespace strata::tools::explain
