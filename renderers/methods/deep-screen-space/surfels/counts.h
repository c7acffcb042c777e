#pragma once

#include "renderers/methods/deep-screen-space/surfels/patches.h"

namespace ir::methods::deep_screen_space {

/// The row of "surfels.counts".
struct SurfelCounts {
    std::uint32_t triangles, left, patches, fine, kept;
    float fine_area, kept_area;  ///< m²
    float fine_part, kept_part;  ///< means of area over ideal area
    IR_FIELDS(triangles, left, patches, fine, kept, fine_area, kept_area, fine_part, kept_part)
};

/// Declares the table and what it needs; nothing of it runs while nobody looks.
void count_surfels(graph::GraphBuilder& builder, const Patches& patches, const Growing& fine,
                   const Surfels& surfels, const Parameters& parameters);

}  // namespace ir::methods::deep_screen_space
