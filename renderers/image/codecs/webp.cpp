#include "renderers/image/codecs/webp.h"

#include <webp/decode.h>

namespace ir {

DecodedTexels decode_webp(std::span<const std::uint8_t> bytes, std::int64_t max_pixels) {
    DecodedTexels result;
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK ||
        std::int64_t{features.width} * features.height > max_pixels) {
        result.error = "is damaged";
        return result;
    }
    if (features.has_animation) {
        result.error = "is animated";
        return result;
    }
    result.width = features.width;
    result.height = features.height;
    const int stride = 4 * result.width;
    result.rgba.resize(static_cast<std::size_t>(stride) * static_cast<std::size_t>(result.height));
    if (!WebPDecodeRGBAInto(bytes.data(), bytes.size(), result.rgba.data(), result.rgba.size(), stride))
        result.error = "is damaged";
    return result;
}

}  // namespace ir
