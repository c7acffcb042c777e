#pragma once

#include <cstdint>

/// Limits of a document's values, the same for file, window and command line.
namespace ir {

/// Pixels on a side that a document may ask for; devices may offer less.
inline constexpr int max_image_side = 65536;
/// Frames of one picture.
inline constexpr int max_frames = 1'000'000'000;
/// Samples per pixel over all frames of a picture.
inline constexpr std::int64_t max_samples = 1'000'000'000;
/// Of a time, before or after 0.
inline constexpr double max_seconds = 1e9;
/// Of a perspective camera's vertical field of view.
inline constexpr double min_fov_degrees = 0.001, max_fov_degrees = 179.999;
/// Runs of which a measurement takes the median.
inline constexpr int max_repeats = 1000;

}  // namespace ir
