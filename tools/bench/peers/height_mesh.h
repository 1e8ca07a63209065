// A surface sampled where a line from straight above first meets it, as a triangle mesh for Embree.
#pragma once

#include <embree3/rtcore.h>

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

#include "src/integrate/surface_image.h"

namespace strata::tools::bench {

// A grid of side x side heights over [x0,x1] x [z0,z1].
struct HeightGrid {
    int side = 0;
    double x0 = 0, x1 = 0, z0 = 0, z1 = 0;
    std::vector<float> y;  // row by row, x first

    double x_at(double column) const { return x0 + (x1 - x0) * column / (side - 1); }
    double z_at(double row) const { return z0 + (z1 - z0) * row / (side - 1); }
};

// What a camera that looks along +z sees up to its far end, and a strip behind it. Heights are the fast tracer's, to
// 1e-6; or those of `cache`, which is written when it is not there.
HeightGrid sample_heights(const integrate::SurfaceImage& image, const scene::Scene& scene, int side,
                          const std::filesystem::path& cache);

// First heights below the highest point possible at (x, z).
std::vector<float> heights_from_above(const integrate::SurfaceImage& image, const std::vector<glm::dvec2>& xz);

// rms and greatest distance, straight up or down, of the mesh from the surface, at 65536 points spread over the grid.
struct HeightError {
    double rms = 0, greatest = 0;
};
HeightError height_error(const integrate::SurfaceImage& image, const HeightGrid& grid);

// Two triangles a cell, in a scene of its own.
RTCScene build_mesh(RTCDevice device, const HeightGrid& grid);

}  // namespace strata::tools::bench
