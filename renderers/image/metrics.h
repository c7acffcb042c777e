#pragma once

#include <map>
#include <string>
#include <vector>

#include "renderers/image/image.h"

namespace ir {

struct MetricResult {
    std::map<std::string, double> values;  ///< by metric name
    std::size_t pixels = 0;                ///< that were compared
    std::size_t skipped = 0;               ///< invalid (mask 0 or NaN/Inf) in either image
};

/// Names that compute_metrics knows, over all channels of the compared pixels: rmse, mae (root mean square
/// and mean absolute error, in the image's unit) and psnr (decibels, peak 1; infinite for equal images).
const std::vector<std::string>& metric_names();

/// Compares two images of equal size; RGBA is compared by RGB. `mask_a`/`mask_b` (1 channel, may be null)
/// mark valid pixels by values above 0.5. Without any valid pixel all values are NaN. Throws UsageError for
/// sizes that differ (naming both) and for unknown metrics.
MetricResult compute_metrics(const Image& image, const Image& reference,
                             const std::vector<std::string>& metrics, const Image* mask_a = nullptr,
                             const Image* mask_b = nullptr);

/// image - reference, per channel (three for RGBA). Throws UsageError like compute_metrics.
Image signed_difference(const Image& image, const Image& reference);

}  // namespace ir
