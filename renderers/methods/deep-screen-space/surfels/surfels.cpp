#include "renderers/methods/deep-screen-space/surfels.h"

#include <cmath>

#include "renderers/methods/deep-screen-space/surfels/steps.h"

namespace ir::methods::deep_screen_space {

Surfels make_surfels(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                     const passes::ShadowMaps& shadow, float reach, const Parameters& parameters) {
    const auto& view = builder.inputs().view;
    const double pixels = static_cast<double>(view.width) * view.height;
    const double triangles = static_cast<double>(builder.inputs().world->indices.size()) / 3;
    const auto room_for = [&](double per_pixel, double per_triangle) {
        return static_cast<std::uint64_t>(
            std::ceil(parameters.reserve * (per_pixel * pixels + per_triangle * triangles)));
    };
    const auto reserve = room_for(1, 0);
    const auto fine = declare_fine(builder, room_for(2, 0.65));  // three for a triangle however small
    const auto patches = cut_patches(builder, scene, fine.count, reach, room_for(0.1, 0.25), parameters);
    tessellate(builder, scene, patches, fine, parameters);
    const auto surfels = thin(builder, scene, fine, reserve, parameters);
    if (parameters.transport.paths != Transport::Paths::ao)
        shade(builder, scene, shadow, surfels, parameters);
    show_surfels(builder, surfels, reserve, parameters);
    count_surfels(builder, patches, fine, surfels, parameters);
    return surfels;
}

}  // namespace ir::methods::deep_screen_space
