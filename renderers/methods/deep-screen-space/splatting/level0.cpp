#include "renderers/methods/deep-screen-space/splatting/visible.h"
#include "renderers/methods/deep-screen-space/surfels/view.h"
#include "renderers/passes/bounce/tiles.h"

namespace ir::methods::deep_screen_space {
namespace {

/// Constants of exact.comp.
struct ExactRays {
    InfluenceConstants influence;
    Ideal ideal;
    float max_distance;
    IR_FIELDS(influence, ideal, max_distance)
};

}  // namespace

void trace_level0(graph::GraphBuilder& builder, const VisibleSplats& visible, const std::string& batch) {
    const auto& parameters = visible.splats.parameters;
    auto pass = builder.pass("exact rays of level 0" + batch);
    pass.reads(visible.gbuffer.position, visible.gbuffer.geometric_normal)
        .reads("directions", visible.directions.directions)
        .reads("BvhNodes", visible.bvh.nodes)
        .reads("BvhTriangles", visible.bvh.triangles)
        .reads("BvhMasks", visible.bvh.masks)
        .reads(visible.scene.opacity, visible.scene.opacity_words)
        .writes("exact_image", visible.exact);
    passes::bounce::compute_by_tiles(
        pass, builder, {{folder + "exact.comp"}},
        ExactRays{influence_constants(visible.splats), ideal(builder.inputs().view, parameters),
                  parameters.transport.max_distance});
}

}  // namespace ir::methods::deep_screen_space
