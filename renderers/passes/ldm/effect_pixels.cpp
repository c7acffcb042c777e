#include "renderers/passes/ldm/effect_pixels.h"

#include <algorithm>

namespace ir::passes::ldm {

EffectPixels effect_grid(const scene::View& view, int most) {
    const int bound = std::clamp(most, 1, most_effect_pixels);
    EffectPixels grid{{0, 0}, {view.width, view.height}, 1};
    while (grid.cells.x * grid.cells.y > bound) {
        ++grid.pixel_step;
        grid.cells = (glm::ivec2(view.width, view.height) + grid.pixel_step - 1) / grid.pixel_step;
    }
    grid.first_pixel = glm::ivec2(grid.pixel_step / 2);
    return grid;
}

EffectPixels picked_effect_pixel(const graph::FrameInputs& inputs) {
    return {inputs.picked_pixel(), {1, 1}, 1};
}

}  // namespace ir::passes::ldm
