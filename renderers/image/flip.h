#pragma once

#include "renderers/image/image.h"

/// ꟻLIP: how different two pictures look to a person who flips between them [Andersson20].
namespace ir {

struct FlipOptions {
    /// Pixels per degree of visual angle: a 0.7 m wide screen of 3840 pixels seen from 0.7 m.
    double pixels_per_degree = 67.0206;
};

/// LDR-ꟻLIP error per pixel, 0 … 1, one channel. Inputs are linear; they are clipped to 0 … 1 as a screen
/// does. One channel counts as grey, the fourth is ignored. Pixels that `valid` (may be null) excludes, or
/// that are NaN or infinite in either image, are black in both, so that they add no error to their
/// neighbours'. Throws UsageError for sizes and channels that differ, other numbers of channels, and
/// pixels_per_degree outside 1 … 1000. [Andersson20]
Image flip_error(const Image& image, const Image& reference, const FlipOptions& options = {},
                 const Image* valid = nullptr);

/// Exposures, in stops, at which HDR pictures are looked at.
struct FlipExposures {
    double start = 0, stop = 0;
    int count = 1;
    double at(int i) const { return count > 1 ? start + i * (stop - start) / (count - 1) : start; }
};

/// From the exposure at which the reference's brightest pixel is nearly white to the one at which its median
/// is, in steps of about a stop [Andersson21 §4]. A reference whose median is black counts by the median of
/// what is not; a black one takes the image's range; with both black there is one exposure, 0. Never more
/// than `max_flip_exposures`: steps grow instead.
FlipExposures flip_exposures(const Image& image, const Image& reference, const Image* valid = nullptr);
inline constexpr int max_flip_exposures = 32;

struct HdrFlipResult {
    Image error;                 ///< as flip_error
    double start = 0, stop = 0;  ///< exposures, stops
    int exposures = 0;
    Image exposure_map;  ///< index of the exposure whose error is the largest, one channel
};

/// HDR-ꟻLIP: the largest LDR error over flip_exposures(), tone mapped by ACES. Else as flip_error; negative
/// values are black. [Andersson21]
HdrFlipResult hdr_flip_error(const Image& image, const Image& reference, const FlipOptions& options = {},
                             const Image* valid = nullptr);

}  // namespace ir
