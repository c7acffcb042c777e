#include "renderers/methods/deep-screen-space/surfels.h"

#include <cmath>

#include "renderers/methods/deep-screen-space/surfels/counts.h"
#include "renderers/methods/deep-screen-space/surfels/shading.h"
#include "renderers/methods/deep-screen-space/surfels/showing.h"
#include "renderers/methods/deep-screen-space/surfels/thinning.h"

namespace ir::methods::deep_screen_space {

Surfels make_surfels(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                     const passes::ShadowMaps& shadow, float reach, const Parameters& parameters) {
    const auto& view = builder.inputs().view;
    const double pixels = static_cast<double>(view.width) * view.height;
    const auto reserve = static_cast<std::uint64_t>(std::ceil(parameters.reserve * pixels));
    const auto fine = declare_fine(builder, reserve);
    const auto patches = cut_patches(builder, scene, fine.count, reach, reserve, parameters);
    tessellate(builder, scene, patches, fine, parameters);
    const auto surfels = thin(builder, scene, fine, reserve, parameters);
    if (parameters.transport.paths != Transport::Paths::ao)
        shade(builder, scene, shadow, surfels, parameters);
    show_surfels(builder, surfels, reserve, parameters);
    count_surfels(builder, patches, fine, surfels, parameters);
    return surfels;
}

}  // namespace ir::methods::deep_screen_space
