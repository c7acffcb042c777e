#pragma once

#include <functional>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/deep-screen-space/parameters.h"
#include "renderers/methods/deep-screen-space/splatting/hierarchy.h"
#include "renderers/methods/deep-screen-space/surfels.h"
#include "renderers/passes/bounce/samples.h"

namespace ir::methods::deep_screen_space {
/// Of the surfels: so finely can work on them be sliced.
inline constexpr std::int64_t surfel_parts = 256;

/// What all draws of splats share.
struct Splats {
    Hierarchy hierarchy;
    Surfels surfels;
    graph::BufferRef rectangles;      ///< "splats.rectangles": of the surfels drawn last
    graph::BufferRef command;         ///< "splats.command"
    graph::CounterRef drawn, culled;  ///< "splats.drawn", "splats.culled"; none: draws are not counted
    Reach reach{};
    Parameters parameters;
    int samples = 1;               ///< of a batch: layers are (sample, level) pairs; sample-major
    int first_sample = 0;          ///< of the batch, among all
    std::string fingerprint = {};  ///< of what is drawn, where it depends on no light
    bool open_glass = false;       ///< there is glass, and it lets rays through

    /// Without visibility surfels that send no light do nothing; highlights are not stored.
    bool dark_is_idle() const {
        return !parameters.visibility && parameters.transport.paths != Transport::Paths::ao &&
               !sends_highlights(parameters);
    }
};

/// Declares what draws need. `batches`: of one sample without visibility.
Splats declare_splats(graph::GraphBuilder& builder, const Hierarchy& hierarchy, const Surfels& surfels,
                      const Parameters& parameters, const passes::bounce::Batches& batches);

/// Declares "splats.by_surfel", for people to look at.
void show_culling(graph::GraphBuilder& builder, const Splats& splats);

/// A part of the surfels that is to be drawn into one layer.
struct SplatLayer {
    int sample = 0, level = 0;         ///< the sample counted from the batch's first
    std::uint64_t first = 0, end = 0;  ///< surfels, as far as they are stored
    bool is_first = true;              ///< the first part of this layer: time to clear
};

/// Binds the framebuffer of a layer (of the hierarchy's size), the program, which has "splat.vert" for its
/// vertex stage, and what its other stages read, constants among it; sets blending and depth test.
using BindLayer = std::function<const gl::Program&(const graph::PassContext&, const SplatLayer&)>;

/// Adds to `pass`, which declares all else that `bind` touches, the draws of all surfels into all layers, one
/// layer after the other, each in the order of the surfels.
///
/// Before each draw a compute pass finds the rectangle of places that a surfel can affect: of the sphere of
/// radius d · 2^l around its centre, in one sub-image that is chosen at random. [Nalbach15 §4.1]
void draw_splats(graph::PassBuilder pass, const Splats& splats, const BindLayer& bind);

/// Declares "splats.cover", rg32f stack of the hierarchy's size, a layer for each sample and level: how many
/// splats cover each place, and how many of them have its surface within reach. It is drawn only for those
/// who look at it.
graph::ImageRef count_cover(graph::GraphBuilder& builder, const Splats& splats);

/// Constants of influence.glsl. Estimated, d is a surfel's r / √ε where that is more than the
/// constant one. DEVIATION [Nalbach15 §4.2]: "d_max is a constant": where that is only a few radii, enlarged
/// discs are as wide as their distance and hide what is beside them. Ambient occlusion with 5 levels, RMSE
/// constant and so: 0.128 and 0.062 in a Cornell box (0.5 m, 128²), 0.277 and 0.078 on a still life (0.3 m,
/// 256²). None reaches less far than published, so dark surfels block as far as others.
struct InfluenceConstants {
    float shell_radius, whole_reach, trade_off;
    int open_level;
    IR_FIELDS(shell_radius, whole_reach, trade_off, open_level)
};
InfluenceConstants influence_constants(const Splats& splats);

/// Constants of splat_common.glsl.
struct SplatConstants {
    InfluenceConstants influence;
    int level, sample_index;
    IR_FIELDS(influence, level, sample_index)
};
SplatConstants splat_constants(const Splats& splats, const SplatLayer& layer);

/// Whether of several levels with a hit the nearest hit decides, and not that of the finest level.
inline bool nearest_decides(const Splats& splats) {
    return splats.parameters.influence == Influence::estimated;
}

/// Constants of sphere_bounds.glsl.
struct SphereBounds {
    glm::mat4 view_from_world;
    glm::vec2 pixel_scale, pixel_offset;
    float near_plane, far_plane;
    bool perspective;
    glm::ivec2 view_size;
    IR_FIELDS(view_from_world, pixel_scale, pixel_offset, near_plane, far_plane, perspective, view_size)
};
SphereBounds sphere_bounds(const scene::View& view);

std::vector<OutputDescription> splat_outputs();

}  // namespace ir::methods::deep_screen_space
