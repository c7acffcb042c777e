#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "renderers/image/image.h"

namespace ir {

struct DecodedImage {
    Image image;  ///< values as the file has them, integers as fractions of their maximum
    bool is_srgb = false;
    int levels = 0;  ///< steps from 0 to 1 that the file's integers have; 0: of floats
    int alpha_channel = -1;
    std::string error;  ///< empty where all went well
};

/// What is wrong with a file that would take too much memory.
inline constexpr const char* no_sensible_size =
    "has no sensible size for a file of its length; it seems damaged";

struct EncodedImage {
    std::vector<unsigned char> bytes;
    std::string error;  ///< empty where all went well
};

struct DecodedTexels {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  ///< row 0 at the top, alpha unassociated
    std::string error;               ///< empty where all went well
};

/// What the module image_codecs does, with OpenImageIO, libpng and libwebp.
struct ImageCodecs {
    /// A file in HDR, PNG, JPEG, TIFF or WebP, told by its first bytes. Refuses more than `max_pixels` and
    /// what takes more than `max_bytes` while it is read.
    DecodedImage (*read)(const std::string& file, std::int64_t max_pixels, std::uint64_t max_bytes);
    /// A WebP file in memory, at most `max_pixels` large. Thread-safe.
    DecodedTexels (*webp)(std::span<const std::uint8_t> bytes, std::int64_t max_pixels);
    /// 8 bits a channel, sRGB, of 1, 3 or 4 channels with alpha unassociated.
    EncodedImage (*png)(int width, int height, int channels, std::span<const std::uint8_t> pixels);
};

/// The module, loaded by the first call: OpenImageIO brings some 240 libraries, for which a program would
/// wait a third of a second each time that it starts. Throws Error where the module is missing.
const ImageCodecs& image_codecs();

inline constexpr const char* image_codecs_symbol = "ir_image_codecs";

}  // namespace ir
