#include "renderers/passes/shadow/host_shadow_maps.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/half_float.h"
#include "renderers/graph/image_layers.h"
#include "renderers/passes/scene/light_data.h"

namespace ir::passes {
namespace {

/// receiver_depth of shadow.glsl.
float receiver_depth(const ShadowViewData& view, glm::vec2 ndc, glm::vec3 position_ws, glm::vec3 normal_ws,
                     float depth, float limit) {
    const auto lateral = ndc.x * view.right_ws + ndc.y * view.up_ws;
    const bool perspective = view.perspective != 0;
    const auto origin = perspective ? view.origin_ws : view.origin_ws + lateral;
    const auto direction = perspective ? view.forward_ws + lateral : view.forward_ws;
    const float slope = glm::dot(normal_ws, direction);
    if (slope >= 0) return depth - limit;
    return std::clamp(glm::dot(normal_ws, position_ws - origin) / slope, depth - limit, depth + limit);
}

/// `place`: from the upper left corner, 0 to 1.
glm::vec2 texel_at(glm::vec2 place, int resolution) {
    const auto size = static_cast<float>(resolution);
    // The order of arguments makes 0 of what is no number.
    return glm::min(glm::max(glm::vec2(0), glm::floor(place * size)), glm::vec2(size - 1));
}

std::size_t index_of(glm::vec2 texel, int resolution) {
    return static_cast<std::size_t>(texel.y) * static_cast<std::size_t>(resolution) +
           static_cast<std::size_t>(texel.x);
}

}  // namespace

HostShadowMaps::HostShadowMaps(const graph::PassContext& context, const ShadowMaps& shadow)
    : lights_(light_data(context.inputs().world->lights)),
      layers_(graph::layers<const float>(context, shadow.maps)),
      panes_(graph::layers<const std::uint64_t>(context, shadow.panes)),
      resolution_(context.shape(shadow.maps).width),
      pane_resolution_(context.shape(shadow.panes).width) {
    views_ = shadow_views(*context.inputs().world, resolution_);
}

int HostShadowMaps::layer_of(const LightData& light, glm::vec3 position_ws) const {
    if (light.shadow_layers != 6) return light.shadow_layer;
    const auto offset = position_ws - light.position_ws, size = glm::abs(offset);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return light.shadow_layer + 2 * axis + (offset[axis] < 0 ? 1 : 0);
}

glm::vec3 HostShadowMaps::passed_panes(std::size_t layer, glm::vec2 place) const {
    const auto texel = texel_at(place, pane_resolution_);
    return glm::vec3(unpack_halves(panes_[layer][index_of(texel, pane_resolution_)]));
}

glm::vec3 HostShadowMaps::visibility(std::size_t light, glm::vec3 position_ws, glm::vec3 normal_ws,
                                     glm::vec3 to_light_ws) const {
    const auto& source = lights_[light];
    if (source.shadow_layers == 0) return glm::vec3(1);
    const auto layer = static_cast<std::size_t>(layer_of(source, position_ws));
    const auto& view = views_[layer];
    const bool perspective = view.perspective != 0;
    const auto resolution = static_cast<float>(resolution_);

    const float cosine = std::clamp(glm::dot(normal_ws, to_light_ws), 0.0f, 1.0f);
    const float sine = std::sqrt(1 - cosine * cosine);
    const float reach = perspective ? glm::dot(position_ws - view.origin_ws, view.forward_ws) : 1;
    const float texel_m =
        2 * std::max(glm::length(view.right_ws), glm::length(view.up_ws)) * reach / resolution;
    const auto receiver_ws = position_ws + shadow_normal_offset * texel_m * sine * normal_ws;

    const auto offset = receiver_ws - view.origin_ws;
    const float depth = glm::dot(offset, view.forward_ws), scale = perspective ? 1 / depth : 1;
    const auto ndc =
        scale * glm::vec2(glm::dot(offset, view.right_ws) / glm::dot(view.right_ws, view.right_ws),
                          glm::dot(offset, view.up_ws) / glm::dot(view.up_ws, view.up_ws));
    const auto place = ndc * glm::vec2(0.5f, -0.5f) + 0.5f;
    const auto texel = texel_at(place, resolution_);
    const auto texel_ndc = ((texel + 0.5f) / resolution * 2.0f - 1.0f) * glm::vec2(1, -1);
    const float expected =
        receiver_depth(view, texel_ndc, receiver_ws, normal_ws, depth, shadow_steepest_slope * texel_m);
    if (layers_[layer][index_of(texel, resolution_)] * view.far < expected - shadow_rounding * view.far)
        return glm::vec3(0);
    return passed_panes(layer, place);
}

}  // namespace ir::passes
