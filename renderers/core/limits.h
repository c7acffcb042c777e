#pragma once

#include <algorithm>
#include <cstdint>

/// Limits of what people give, the same for file, window and command line.
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
/// Of a material's factors; those that are fractions lie between 0 and 1.
inline constexpr double max_emission = 1e9;      ///< W/(m² sr)
inline constexpr double max_normal_scale = 100;  ///< on either side
inline constexpr double min_ior = 1, max_ior = 10;
/// Texels on a side that images of any device may have. [OpenGL 4.5, table 23.53]
inline constexpr int max_texture_side = 16384;
/// Runs of which a measurement takes the median.
inline constexpr int max_repeats = 1000;
/// Bytes that what a file keeps compressed may become: pictures seldom reach a hundred times their file,
/// while zip reaches 1032 for zeros. A file of 1 MiB takes 0.5 GiB at most.
constexpr std::uint64_t max_expanded(std::uint64_t file_bytes) {
#ifdef INTERREFLECT_FUZZING  // a fuzzer would spend its time with filling memory
    constexpr std::uint64_t least_mib = 1;
#else
    constexpr std::uint64_t least_mib = 512;
#endif
    return std::max(least_mib << 20, 256 * file_bytes);
}

}  // namespace ir
