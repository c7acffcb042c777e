#pragma once

#include "renderers/image/image.h"

namespace ir {

/// Structural similarity of each pixel's neighbourhood, -1 … 1, the mean over the channels: windows of 11 ×
/// 11 pixels weighted by a Gaussian of σ = 1.5, K1 = 0.01, K2 = 0.03, and a data range of 1 [Wang04 eq. 13].
/// Pixels that `valid` excludes (may be null), that are NaN or infinite in either image, or that lie outside
/// have no weight, and the weights of the others add up to 1; [Wang04] leaves out windows that reach over the
/// border. NaN at pixels without a value of their own. Throws UsageError for sizes and channels that differ.
Image ssim_map(const Image& image, const Image& reference, const Image* valid = nullptr);

}  // namespace ir
