#pragma once

#include <memory>

#include "renderers/passes/ldm/builder.h"

namespace ir::passes::ldm {

/// Consecutive maps.
struct MapRange {
    int first = 0, count = 0;
    /// The part of it in a batch, counted among all maps; may be empty.
    MapRange in_batch(const Maps& maps, int batch) const;
};

/// The entries of some maps as points of the scene. [Aalund15 Fig. 3]
struct Points {
    MapRange maps;
    std::uint64_t stride = 1;  ///< every so many texels are shown, so that at most about four million result
    std::uint64_t reserved = 0;      ///< elements that are reserved at first
    graph::BufferRef points;         ///< "ldm.points"
    graph::BufferRef texels;         ///< first point of each texel
    graph::BufferRef state, strips;  ///< of rasterising again
    graph::CounterRef count, stride_shown, strips_requested;
};

/// Declares resources.
Points declare_points(graph::GraphBuilder& builder, const Maps& maps, MapRange shown);

/// Declares passes "points" and "point faces" for the maps shown of a batch, which was built; where they run,
/// the frame's notes tell a stride of more than 1. The maps hold
/// depths alone: faces come from rasterising the same triangles again by the same builder. A fragment and an
/// entry belong together where texel and depth in quanta are equal, so facing and normal are exact. Among
/// entries of equal depth faces take turns (shaders/passes/ldm/point_ties.comp).
void find_points(graph::GraphBuilder& builder, const SceneBuffers& scene, std::shared_ptr<const Maps> maps,
                 int batch, const Points& points);

/// Declares "ldm.xray" and, once points of all batches are found, the pass "x-ray": each point as the piece
/// of surface that its texel stands for.
void show_sheets(graph::GraphBuilder& builder, const Maps& maps, const Points& points);

}  // namespace ir::passes::ldm
