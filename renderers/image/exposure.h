#pragma once

#include "renderers/image/image.h"

namespace ir {

/// Stops by which a picture of light is brightened so that it looks well exposed: its logarithmic mean
/// becomes middle grey [Reinhard02 eq. 1], but at most a seventh of it is brighter than white, and of the
/// brightest hundredth at least the darkest comes near white. In quarters of a stop, so that noise does not
/// make pictures flicker. Of luminance, or of the only channel; pixels without light and those that are not
/// finite do not count. 0 for a picture without any light.
double automatic_exposure(const Image& image);

}  // namespace ir
