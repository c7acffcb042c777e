#pragma once

#include "renderers/image/image.h"

namespace ir {

/// 1 where the picture shows one smooth sheet around the pixel, else 0: away from geometric edges, where
/// methods err that know surfaces by pixels or texels only. Up to 1/75 of the picture's height away (4 of 300
/// pixels, at least one) normals are within 25° of the pixel's own, and positions deviate from its tangent
/// plane by less than a fifth of their distance. Unit normals and positions of one space, of equal size;
/// normals of the background are 0.
Image flat_pixels(const Image& normal, const Image& position);

}  // namespace ir
