#pragma once

#include <string>
#include <vector>

#include "renderers/graph/builder.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/scene/scene_buffers.h"
#include "renderers/passes/shadow/shadow_maps.h"

namespace ir::passes {

struct RsmOptions {
    std::vector<ShadowViewData> views;  ///< a layer each
    int resolution = 256;               ///< texels along a side
    bool opaque_only = false;           ///< transmission is ignored
    bool normal_maps = true;
    bool depth_prepass = false;     ///< what lies behind a depth that is drawn first is not shaded
    bool geometric_normal = false;  ///< keeps the normals of triangles, too
    /// On the host the map may be found by rays; depths and filtered textures then differ by rounding from
    /// those of a map that is drawn.
    bool may_be_traced = false;
    /// Half floats: steps of 1/255 are 10 % of a reflectance of 0.02.
    bool exact_albedo = false;
    bool views_differ = false;  ///< from those of another frame of the same world: nothing is kept
};

/// Constants of shaders/passes/rsm/cone.glsl: a spot shines where the cosine to its axis is no less.
struct LightCone {
    glm::vec3 cone_axis_ws{0};
    float cone_cosine = -2;  ///< the light has no cone
    IR_FIELDS(cone_axis_ws, cone_cosine)
};
LightCone light_cone(const scene::World& world, const ShadowViewData& view);

/// Reflective shadow maps: what each light sees, one layer per shadow view. Empty texels are 0, and so are
/// those outside a spot's cone. [Smal19 §5.1]
struct Rsm {
    graph::ImageRef albedo_roughness;  ///< "rsm.albedo_roughness" rgba8, or rgba16f with exact_albedo: linear
                                       ///< base colour, roughness
    graph::ImageRef normal_metalness;  ///< "rsm.normal_metalness" rgba16f: shading normal on the light's
                                       ///< side; w: 1 + metalness, negative where nothing is scattered
    graph::ImageRef geometric_normal;  ///< "rsm.geometric_normal" rgba32f: of the triangle's plane, on the
                                       ///< light's side; a: the part that is no glass; invalid where it
                                       ///< was not asked for
    graph::ImageRef depth;             ///< "rsm.depth" depth32f: as "shadow.maps"
    graph::BufferRef views;            ///< "rsm.views": a ShadowViewData for each layer
    int resolution = 0, layers = 0;    ///< without views one empty layer
    int views_drawn = 0;               ///< layers that have a view
    std::string fingerprint;           ///< of the contents
};

/// Declares the pass "RSM" (and "RSM depth"), which draw only when world, resolution or materials change.
Rsm draw_rsm(graph::GraphBuilder& builder, const SceneBuffers& scene, const RsmOptions& options);

/// What programs that look an RSM up read.
void reads_rsm(graph::PassBuilder& pass, const Rsm& rsm, const SceneBuffers& scene);

std::vector<OutputDescription> rsm_outputs(const Condition& active_when = {}, bool geometric_normal = false);

}  // namespace ir::passes
