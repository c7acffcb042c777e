#pragma once

#include "renderers/image/image.h"

namespace ir {

/// Whether an image of the smaller size can show what one of the larger size shows: smaller in both
/// directions, and in the same proportions up to one texel, as sizes are rounded.
bool is_reduced(int width, int height, int larger_width, int larger_height);

/// Each pixel takes the texel that covers its centre, as probes of pixels do. Where the ratio is whole every
/// texel covers equally many pixels, and nothing is interpolated anywhere.
Image enlarged(const Image& image, int width, int height);

}  // namespace ir
