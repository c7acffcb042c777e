#pragma once

#include <string>
#include <vector>

#include "renderers/image/image.h"

namespace ir {

struct FlipOptions {
    /// Pixels per degree of visual angle: a 0.7 m wide screen of 3840 pixels seen from 0.7 m.
    double pixels_per_degree = 67.0206;
};

/// LDR-ꟻLIP error per pixel, 0 … 1, one channel. Inputs are linear; they are clipped to 0 … 1 as a screen
/// does. One channel counts as grey. Both images of equal size. [Andersson20]
Image flip_error(const Image& image, const Image& reference, const FlipOptions& options = {});

struct HdrFlipResult {
    Image error;                 ///< as flip_error
    double start = 0, stop = 0;  ///< exposures, stops
    int exposures = 0;
    Image exposure_map;  ///< index of the exposure whose error is the largest, one channel
};

/// HDR-ꟻLIP: the largest LDR error over a range of exposures, tone mapped by ACES. The range is that of the
/// reference; sane where the reference is black. [Andersson21]
HdrFlipResult hdr_flip_error(const Image& image, const Image& reference, const FlipOptions& options = {});

}  // namespace ir
