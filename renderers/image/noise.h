#pragma once

#include <vector>

#include "renderers/image/image.h"

/// Whether a difference is more than noise.
namespace ir {

/// The t that a Student-distributed number with `degrees` ≥ 1 degrees of freedom exceeds, in absolute value,
/// with probability `alpha` (1e-9 … 0.5).
double student_quantile(double alpha, int degrees);

/// Half the side of the window that a variance is pooled over, less a half.
inline constexpr int noise_pool_radius = 2;

/// What noise explains of the difference of two pixels: the threshold of |a - b| for one channel, one number
/// a pixel. `variances` are those of the means of each picture (one or two), of the images' size; `channel`
/// is taken of those that have several.
///
/// A pixel's own estimate of its variance rests on few samples, so it is pooled with its neighbours' in
/// the four 3 × 3 windows that have the pixel in a corner, and the largest of these and of its own counts:
/// noise that changes at an edge is not diluted. The quantile is Student's with the degrees of one such
/// window, which is too careful rather than too bold. Neighbours that `valid` excludes or whose variance is
/// not finite are left out; NaN where the pixel's own is.
std::vector<float> noise_threshold(const std::vector<const Image*>& variances, int channel, double alpha,
                                   int degrees, const std::vector<unsigned char>& valid);

}  // namespace ir
