#pragma once

#include <string>

#include "renderers/graph/builder.h"
#include "renderers/methods/deep-screen-space/parameters.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::methods::deep_screen_space {
inline const std::string folder = "methods/deep-screen-space/splatting/";  ///< of the shaders

/// The hierarchical framebuffer: level l holds 4^l sub-images, into which each neighbourhood of 2^l × 2^l
/// pixels gives one pixel each, at random. All levels have the same padded size. [Nalbach15 fig. 5]
struct Hierarchy {
    graph::ImageRef layout;  ///< "hierarchy.layout" r32ui stack, a layer per level: at a place of the level
                             ///< the pixel of the view that stands there, x | y << 16; 0xffffffff: padding
    graph::ImageRef places;  ///< "hierarchy.places" r32ui stack, a layer per level: the inverse; at a pixel
                             ///< of the (padded) view its place in the level
    graph::ImageRef
        positions;  ///< "hierarchy.positions" rgba32f stack: shuffled x_p, w 1; w 0: nothing is there
    graph::ImageRef normals;   ///< "hierarchy.normals" rgba32f stack: shuffled shading normals
    graph::ImageRef min, max;  ///< "hierarchy.min", "hierarchy.max" rgba32f pyramids of the view:
                               ///< bounds of positions below each texel; least > most: nothing there
    int levels = 0, width = 0, height = 0;  ///< padded to a multiple of 2^(levels − 1)
};
Hierarchy shuffle(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Parameters& parameters);

std::vector<OutputDescription> hierarchy_outputs();

/// Declares the pass "framebuffer layout" on the host's threads: what layout.comp writes, bit by bit.
void lay_out_on_host(graph::GraphBuilder& builder, const Hierarchy& hierarchy, unsigned seed);

}  // namespace ir::methods::deep_screen_space
