#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderers/core/fields.h"
#include "renderers/graph/frame_inputs.h"

namespace ir::passes::ldm {

/// Constants of effect_pixels.glsl: the pixels that show what each direction does, a grid or a single one.
struct EffectPixels {
    glm::ivec2 first_pixel, cells;
    int pixel_step;
    IR_FIELDS(first_pixel, cells, pixel_step)
    std::int64_t count() const { return std::int64_t{cells.x} * cells.y; }
};

/// So that a view of a picture takes as long whatever its size.
inline constexpr int most_effect_pixels = 16'384;

/// A grid over the view of at most so many pixels; every pixel if there are no more.
EffectPixels effect_grid(const scene::View& view, int most);
EffectPixels picked_effect_pixel(const graph::FrameInputs& inputs);

}  // namespace ir::passes::ldm
