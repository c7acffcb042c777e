#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderers/image/flip.h"
#include "renderers/image/image.h"

namespace ir {

struct MetricResult {
    std::map<std::string, double> values;  ///< by metric name
    std::size_t pixels = 0;                ///< that were compared
    std::size_t skipped = 0;               ///< invalid (mask 0 or NaN/Inf) in either image
};

/// What each metric is, for lists and tooltips.
struct MetricDescription {
    std::string name, label, doc, unit;
    bool more_is_better = false;  ///< psnr, ssim
};

/// rmse, mae (in the image's unit), relmse, psnr (decibels, peak 1; infinite for equal images), ssim, flip
/// (clipped to what a screen shows) and hdr-flip; over all channels of the compared pixels.
const std::vector<MetricDescription>& metrics();
const std::vector<std::string>& metric_names();

/// Pixels x … x + width - 1 of an image.
struct Rectangle {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const Rectangle&) const = default;
};

struct MetricOptions {
    /// Valid pixels by values above 0.5; one channel; may be null.
    const Image *valid_image = nullptr, *valid_reference = nullptr;
    /// Only pixels inside count; both where both are given. Of metrics that look at neighbourhoods the
    /// neighbours outside still take part.
    std::optional<Rectangle> rectangle;
    const Image* mask = nullptr;
    FlipOptions flip;
};

/// Compares two images of equal size; RGBA is compared by RGB. `mask_a`/`mask_b` (1 channel, may be null)
/// mark valid pixels by values above 0.5. Without any valid pixel all values are NaN. Throws UsageError for
/// sizes that differ (naming both) and for unknown metrics.
MetricResult compute_metrics(const Image& image, const Image& reference,
                             const std::vector<std::string>& metrics, const Image* mask_a = nullptr,
                             const Image* mask_b = nullptr);

/// The same with a region. Throws UsageError for rectangles that lie outside, too.
MetricResult compute_metrics(const Image& image, const Image& reference,
                             const std::vector<std::string>& metrics, const MetricOptions& options);

/// Why two images cannot be compared, in one line: sizes (a turned picture is named as such), channels, or
/// that one of them looks upside down or mirrored. Empty: they can.
std::string why_not_comparable(const Image& image, const Image& reference);

/// image - reference, per channel (three for RGBA). Throws UsageError like compute_metrics.
Image signed_difference(const Image& image, const Image& reference);

}  // namespace ir
