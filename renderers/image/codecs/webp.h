#pragma once

#include "renderers/image/codecs/codecs.h"

namespace ir {

/// ImageCodecs::webp. OpenImageIO 2.4 multiplies colours by alpha and so loses those of texels that are not
/// there, which filters mix in; libwebp keeps them.
DecodedTexels decode_webp(std::span<const std::uint8_t> bytes, std::int64_t max_pixels);

}  // namespace ir
