#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderers/core/uninitialised.h"
#include "renderers/scene/world.h"

namespace ir::passes::ldm {

/// Triangles that lie together: corners by axis, in m. (Vertices that triangles share stand as often as they
/// are used: to transform one again is quicker than to gather it.)
struct Meshlet {
    static constexpr int max_triangles = 64, pack_size = 16;
    /// They stand one after the other in memory, so that processors fetch them in time.
    struct Pack {
        float corner[3][3][pack_size];  ///< corner, axis, triangle
    };
    alignas(64) Pack packs[max_triangles / pack_size];
    int triangles;  ///< beyond the last one all are 0

    float& at(int triangle, int corner, int axis) {
        return packs[triangle / pack_size].corner[corner][axis][triangle % pack_size];
    }
};

/// A world in meshlets. Those without alpha masks stand first; of these the ones with most area, each part in
/// the order of a space-filling curve.
struct Meshlets {
    std::vector<Meshlet, Uninitialised<Meshlet>> meshlets;
    /// Where parts end: what the first ones hide need not be rasterised; behind the opaque ones masks begin.
    std::size_t occluders = 0, opaque = 0;
    /// Of each masked meshlet: its triangles' numbers among the masked ones, as AlphaMasks counts.
    std::vector<std::array<std::uint32_t, Meshlet::max_triangles>> masked_triangles;
    /// Centre and half extent of each meshlet's box by axis, padded to a whole number of vectors.
    std::vector<float> centre[3], half[3];

    std::uint64_t bytes() const;
};

/// `threads` 0 = all. The result does not depend on it.
Meshlets make_meshlets(const scene::World& world, int threads);

}  // namespace ir::passes::ldm
