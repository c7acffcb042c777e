#pragma once

#include <cstdint>
#include <string>

#include "renderers/image/codecs/codecs.h"

namespace ir {

/// ImageCodecs::read of a PNG file. OpenImageIO lets libpng print what is wrong beside the error that it
/// gives, and unpacks texts and colour profiles, of which each may become a thousand times as long.
DecodedImage read_png(const std::string& file, std::int64_t max_pixels, std::uint64_t max_bytes);

}  // namespace ir
