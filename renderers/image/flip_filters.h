#pragma once

#include <vector>

/// The filters of ꟻLIP. All are separable, or sums of separable ones.
namespace ir::flip {

/// Weights at the distances -radius … radius, in pixels.
struct Taps {
    int radius = 0;
    std::vector<float> weights;
};

/// The eye's contrast sensitivity as low-pass filters of the opponent channels [Andersson20 §4.1.1].
/// Blue–yellow is the sum of two filters, whose weights are the roots of those of the 2D filter.
struct ContrastSensitivity {
    Taps luminance, red_green, blue_yellow[2];
};
ContrastSensitivity contrast_sensitivity(double pixels_per_degree);

/// A Gaussian as wide as the eye sees edges and points, and its first two derivatives; the positive and the
/// negative weights of those add up to 1 and -1 [Andersson20 §4.2].
struct FeatureDetectors {
    Taps smooth, edge, point;
};
FeatureDetectors feature_detectors(double pixels_per_degree);

/// The largest radius of any of them.
int largest_radius(double pixels_per_degree);

}  // namespace ir::flip
