#include "renderers/passes/scene/stands_still.h"

#include <algorithm>

namespace ir::passes {
namespace {

bool same_view(const scene::View& a, const scene::View& b) {
    return a.width == b.width && a.height == b.height && a.eye_ws == b.eye_ws &&
           a.clip_from_world() == b.clip_from_world();
}

bool lights_may_move(const scene::Scene& scene) {
    return scene.is_animated() && std::any_of(scene.lights.begin(), scene.lights.end(),
                                              [](const scene::Light& light) { return light.node >= 0; });
}

}  // namespace

bool stands_still(const graph::FrameInputs& inputs, Watched watched) {
    if (!same_view(inputs.view, inputs.previous_view)) return false;
    if (watched == Watched::surfaces_and_lights &&
        (inputs.world->lights_moved || lights_may_move(*inputs.scene)))
        return false;
    return inputs.world->to_previous.empty();
}

}  // namespace ir::passes
