#include "renderers/scene/gltf/image_file.h"

#include <tiny_gltf.h>

#include <array>
#include <cstring>
#include <optional>

#include "renderers/core/error.h"
#include "renderers/core/limits.h"
#include "renderers/image/codecs/codecs.h"
#include "renderers/image/codecs/jpeg.h"
#include "renderers/image/codecs/png.h"

namespace ir::scene::gltf {
namespace {

constexpr std::size_t max_texels = std::size_t{1} << 26;  // 8192 x 8192

int big_endian(const Bytes& bytes, std::size_t offset, int count) {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i) value = (value << 8) | bytes[offset + i];
    return value > INT32_MAX ? INT32_MAX : static_cast<int>(value);
}

std::optional<ImageSize> png_size(const Bytes& bytes) {
    constexpr std::array<std::uint8_t, 8> signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    constexpr std::size_t header_bytes = 33;
    if (bytes.size() < header_bytes || std::memcmp(bytes.data(), signature.data(), signature.size()) != 0)
        return {};
    const bool is_wide = bytes[24] > 8;
    return ImageSize{big_endian(bytes, 16, 4), big_endian(bytes, 20, 4), is_wide ? 12u : 4u};
}

int little_endian(const Bytes& bytes, std::size_t offset, int count) {
    int value = 0;
    for (int i = count; i-- > 0;) value = (value << 8) | bytes[offset + static_cast<std::size_t>(i)];
    return value;
}

bool is_webp(const Bytes& bytes) {
    return bytes.size() >= 25 && std::memcmp(bytes.data(), "RIFF", 4) == 0 &&
           std::memcmp(bytes.data() + 8, "WEBP", 4) == 0;
}

/// Of the first chunk: extended, lossless or lossy. [RFC 9649 §2.5 to §2.7]
std::optional<ImageSize> webp_size(const Bytes& bytes) {
    if (!is_webp(bytes)) return {};
    constexpr int size_mask = (1 << 14) - 1;
    const auto is_chunk = [&](const char* name) { return std::memcmp(bytes.data() + 12, name, 4) == 0; };
    if (is_chunk("VP8L")) {
        constexpr int down_bit = 14 - 8;
        return ImageSize{(little_endian(bytes, 21, 2) & size_mask) + 1,
                         ((little_endian(bytes, 22, 3) >> down_bit) & size_mask) + 1};
    }
    if (bytes.size() < 30) return {};
    if (is_chunk("VP8X")) return ImageSize{little_endian(bytes, 24, 3) + 1, little_endian(bytes, 27, 3) + 1};
    if (!is_chunk("VP8 ")) return {};
    return ImageSize{little_endian(bytes, 26, 2) & size_mask, little_endian(bytes, 28, 2) & size_mask};
}

/// JPEG by stb's decoder through tinygltf, always four channels.
DecodedTexels decode_jpeg(const Bytes& bytes) {
    tinygltf::Image image;
    std::string problems, warnings;
    DecodedTexels texels;
    if (!tinygltf::LoadImageData(&image, 0, &problems, &warnings, 0, 0, bytes.data(),
                                 static_cast<int>(bytes.size()), nullptr) ||
        image.component != 4 || image.bits != 8)
        texels.error = "is damaged";
    texels.width = image.width;
    texels.height = image.height;
    texels.rgba = std::move(image.image);
    return texels;
}

DecodedTexels decode(const Bytes& bytes) {
    const auto most = static_cast<std::int64_t>(max_texels);
    if (is_webp(bytes)) return image_codecs().webp(bytes, most);
    return png_size(bytes) ? decode_png(bytes, most) : decode_jpeg(bytes);
}

}  // namespace

ImageSize probe_image(const std::string& file, const std::string& place, const Bytes& bytes) {
    auto size = png_size(bytes);
    if (const auto jpeg = jpeg_outline(bytes)) {
        if (!jpeg->fault().empty()) throw InputError(file, place, "the image " + jpeg->fault());
        size = ImageSize{jpeg->width, jpeg->height, jpeg->is_progressive ? 10u : 4u};
    }
    if (!size) size = webp_size(bytes);
    if (!size) throw InputError(file, place, "neither a PNG, a JPEG nor a WebP image; convert it to one");
    if (size->width < 1 || size->height < 1)
        throw InputError(file, place, "an image without texels; replace it");
    if (size->width > max_texture_side || size->height > max_texture_side || size->texels() > max_texels)
        throw InputError(file, place,
                         "an image of " + std::to_string(size->width) + "x" + std::to_string(size->height) +
                             " texels; scale it to 8192x8192 or less");
    return *size;
}

std::vector<std::uint8_t> decode_image(const std::string& file, const std::string& place, const Bytes& bytes,
                                       ImageSize size) {
    auto texels = decode(bytes);
    if (texels.error.empty() && (texels.width != size.width || texels.height != size.height ||
                                 texels.rgba.size() != size.texels() * 4))
        texels.error = "is damaged";
    if (!texels.error.empty())
        throw InputError(file, place, "the image " + one_line(texels.error) + "; replace it");
    return std::move(texels.rgba);
}

}  // namespace ir::scene::gltf
