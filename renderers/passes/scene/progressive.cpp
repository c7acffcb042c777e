#include "renderers/passes/scene/progressive.h"

#include <cmath>

#include "renderers/passes/sampling/point_sequence.h"
#include "renderers/passes/scene/stands_still.h"

namespace ir::passes {

int frames_standing(const graph::FrameInputs& inputs) {
    return stands_still(inputs, Watched::surfaces_and_lights) ? inputs.frame : 0;
}

float progressive_shrinking(int frame, float decay) {
    // Π (k + α)/(k + 1) over k = 1 … frame
    const double k = frame, a = decay;
    return static_cast<float>(
        std::exp(0.5 * (std::lgamma(k + 1 + a) - std::lgamma(1 + a) - std::lgamma(k + 2))));
}

std::uint64_t frame_seed(const graph::FrameInputs& inputs) {
    return mixed(mixed(inputs.seed) + static_cast<std::uint64_t>(inputs.frame));
}

}  // namespace ir::passes
