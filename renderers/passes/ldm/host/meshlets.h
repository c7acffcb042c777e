#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderers/scene/world.h"

namespace ir::passes::ldm {

/// Triangles that lie together: corners by axis, in m. (Vertices that triangles share stand as often as they
/// are used: to transform one again is quicker than to gather it.)
struct Meshlet {
    static constexpr int max_triangles = 64;
    alignas(64) float x[3][max_triangles], y[3][max_triangles], z[3][max_triangles];
    int triangles = 0;  ///< beyond the last one all are 0
};

/// A world in meshlets. Those without alpha masks stand first, in stages: what has most area first, each
/// stage in the order of a space-filling curve.
struct Meshlets {
    static constexpr int stages = 4;
    std::vector<Meshlet> meshlets;
    /// Where stages end; what earlier ones hide need not be rasterised. Behind the last one masks begin.
    std::size_t stage_ends[stages] = {};
    std::size_t opaque() const { return stage_ends[stages - 1]; }
    /// Of each masked meshlet: its triangles' numbers among the masked ones, as AlphaMasks counts.
    std::vector<std::array<std::uint32_t, Meshlet::max_triangles>> masked_triangles;
    /// Centre and half extent of each meshlet's box by axis, padded to a whole number of vectors.
    std::vector<float> centre[3], half[3];

    std::uint64_t bytes() const;
};

/// `threads` 0 = all. The result does not depend on it.
Meshlets make_meshlets(const scene::World& world, int threads);

}  // namespace ir::passes::ldm
