#pragma once

#include <string>

#include "renderers/methods/deep-screen-space/surfels.h"
#include "renderers/passes/bounce/samples.h"

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

/// Splatting without visibility: every surfel adds its form factor, or the light that it sends there, on one
/// level by distance; levels are blurred (by the blur's parameters, as many pixels of the level) and added.
/// The image that `text` describes: accessibility r32f or reflected radiance rgba32f. [Nalbach14]
graph::ImageRef splat_additive(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                               const passes::GBuffer& gbuffer, const passes::ShadowMaps& shadow,
                               const Hierarchy& hierarchy, const Surfels& surfels,
                               const Parameters& parameters, graph::ResourceText text);

std::vector<OutputDescription> hierarchy_outputs();
std::vector<OutputDescription> splat_outputs();
std::vector<OutputDescription> visible_outputs();   ///< only with visibility
std::vector<OutputDescription> additive_outputs();  ///< only without

}  // namespace ir::methods::deep_screen_space
