#pragma once

#include <span>
#include <vector>

#include "renderers/core/output.h"
#include "renderers/image/image.h"

namespace ir {

enum class DifferenceKind {
    signed_,     ///< a - b
    absolute,    ///< |a - b|
    relative,    ///< |a - b| / (|b| + relative_difference_floor)
    squared,     ///< (a - b)²
    flip,        ///< ꟻLIP error of what a screen shows, one channel [Andersson20]
    hdr_flip,    ///< HDR-ꟻLIP error, one channel [Andersson21]
    significant  ///< a - b where noise does not explain it, else 0; needs variances
};

/// What people and files call it.
struct DifferenceText {
    DifferenceKind kind;
    const char *key, *title, *doc;
    bool has_sign;  ///< values may be below 0
};
/// All kinds; the first is the usual one.
std::span<const DifferenceText> difference_kinds();

/// Keeps the relative difference finite where the reference is black; in the images' unit.
inline constexpr float relative_difference_floor = 0.01f;

/// Differences, and where there are any.
struct DifferenceImage {
    Image image;  ///< NaN where there is no value
    Image valid;  ///< 1 or 0, one channel; empty when every pixel has a value
};

/// Compares two images of equal size by the channels that are values (channels.h). A pixel that a mask (one
/// channel, valid above 0.5; may be null) excludes in either image has no value: it must not read as an error
/// of 0. NaN and Inf of valid pixels go through the arithmetic and stay visible. Throws UsageError for sizes
/// that differ (naming both) and for channels that do.
DifferenceImage difference(const Image& a, const Image& b, DifferenceKind kind,
                           const Image* valid_a = nullptr, const Image* valid_b = nullptr,
                           Semantic semantic = Semantic::radiance);

/// Variances of the mean of each picture, per channel or one for all (null: that picture has no noise), and
/// how sure one wants to be.
struct Noise {
    const Image *variance_a = nullptr, *variance_b = nullptr;
    /// Probability that a pixel without any error shows one.
    double alpha = 1e-4;
    /// Degrees of freedom of a pixel's own estimate of its variance.
    int degrees = 7;
};

/// As above with what `significant` needs. Throws UsageError when it is asked for without any variance.
DifferenceImage difference(const Image& a, const Image& b, DifferenceKind kind, const Noise& noise,
                           const Image* valid_a, const Image* valid_b,
                           Semantic semantic = Semantic::radiance);

/// What the colours of a difference span, from the magnitudes of its pixels: the one that a hundredth of them
/// exceeds, so that a few outliers do not make the rest pale, but no less than a twentieth of the largest, so
/// that rounding does not look like an error. Values that are not finite do not count; 1 where all are 0.
double shown_extent(std::vector<float> magnitudes);

}  // namespace ir
