#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "renderers/image/codecs/codecs.h"

namespace ir {

/// ImageCodecs::read of a PNG file. OpenImageIO lets libpng print what is wrong beside the error that it
/// gives, and unpacks texts and colour profiles, of which each may become a thousand times as long.
DecodedImage read_png(const std::string& file, std::int64_t max_pixels, std::uint64_t max_bytes);

/// A PNG file in memory, at most `max_pixels` large. In no more memory than its texels take, whatever the
/// file has. Thread-safe.
DecodedTexels decode_png(std::span<const std::uint8_t> bytes, std::int64_t max_pixels);

}  // namespace ir
