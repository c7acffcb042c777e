#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderers/core/output.h"
#include "renderers/core/progress.h"
#include "renderers/image/flip.h"
#include "renderers/image/image.h"

namespace ir {

struct MetricResult {
    std::map<std::string, double> values;    ///< by metric name
    std::size_t pixels = 0;                  ///< that were compared
    std::size_t skipped = 0;                 ///< invalid (mask 0 or NaN/Inf) in either image
    std::optional<FlipExposures> exposures;  ///< those of hdr-flip, when it was computed
};

/// Which values of a metric are good: near_zero has a sign that says in which direction the image errs, and
/// `none` is no error but tells what errors are of.
enum class Best { lowest, highest, near_zero, none };

/// What each metric is, for lists, tooltips and the manual.
struct MetricDescription {
    std::string name, label, doc;
    std::string unit;  ///< "dB"; empty: none, or the images' own
    Best best = Best::lowest;
    std::string citation = {};  ///< keys of REFERENCES.bib
};

/// Less is better, whatever the metric: NaN where it is no error.
double badness(const MetricDescription& metric, double value);

/// rmse, mae, bias (in the image's unit), relbias (of the reference's mean), relmse, psnr (decibels, peak 1;
/// infinite for equal images), ssim, flip (clipped to what a screen shows) and hdr-flip, then mean and
/// reference-mean, which are no errors; over all channels of the compared pixels.
const std::vector<MetricDescription>& metrics();
const std::vector<std::string>& metric_names();

/// Throws UsageError that lists the known names.
const MetricDescription& metric(const std::string& name);

/// Why a value is not finite: "infinite", "minus infinite" or "undefined", and for a metric ": the pictures
/// are equal" or another cause. Empty for finite values.
std::string why_not_finite(double value, const std::string& metric = {}, std::size_t pixels = 1);

/// Keeps the relative squared error (a - b)² / (b² + ε) finite where the reference is black; in the square of
/// the images' unit.
inline constexpr double relmse_epsilon = 0.01;

/// Pixels x … x + width - 1 of an image, and so on downwards.
struct Rectangle {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const Rectangle&) const = default;
};

struct MetricOptions {
    /// Of both images: says which channels are compared (channels.h).
    Semantic semantic = Semantic::radiance;
    /// Valid pixels by values above 0.5; one channel; may be null.
    const Image* valid_image = nullptr;
    const Image* valid_reference = nullptr;
    /// Only pixels inside count; both where both are given. Of metrics that look at neighbourhoods the
    /// neighbours outside still take part; invalid pixels never do.
    std::optional<Rectangle> rectangle = {};
    const Image* mask = nullptr;
    FlipOptions flip = {};
    const CancelToken* cancel = nullptr;  ///< looked at before each metric
};

/// Compares two images of equal size by the channels that are values. `pixels` and `skipped` add up to the
/// region. Without any valid pixel all values are NaN. Throws UsageError for sizes that differ (naming both),
/// for unknown metrics, for rectangles that are empty or lie outside, and for ꟻLIP of other than 1 or 3
/// channels. Throws Cancelled.
MetricResult compute_metrics(const Image& image, const Image& reference,
                             const std::vector<std::string>& metrics, const MetricOptions& options = {});

/// How pictures may fail to be comparable.
enum class Misfit { none, size, channels, orientation };
struct Comparability {
    Misfit misfit = Misfit::none;
    std::string why;  ///< one line; empty for none
};

/// Whether two images can be compared: sizes (a turned picture is named as such), channels, and whether one
/// of them looks upside down or mirrored. That is said only where the turned picture fits more than twice as
/// well as the other and well in itself, so that neither symmetric nor noisy pictures are suspected.
Comparability comparability(const Image& image, const Image& reference,
                            Semantic semantic = Semantic::radiance);

/// comparability().why.
std::string why_not_comparable(const Image& image, const Image& reference,
                               Semantic semantic = Semantic::radiance);

/// image - reference of colours or greys, per channel. Throws UsageError like compute_metrics.
Image signed_difference(const Image& image, const Image& reference);

}  // namespace ir
