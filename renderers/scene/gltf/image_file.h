#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderers/scene/gltf/source.h"

namespace ir::scene::gltf {

struct ImageSize {
    int width = 0, height = 0;
    std::size_t working_bytes = 4;  ///< held for each texel beside its four while it is decoded
    std::size_t texels() const { return static_cast<std::size_t>(width) * height; }
};

/// Size from the header of a PNG, JPEG or WebP file, before anything is decoded. Throws InputError for other
/// formats and for images of more than 2^26 texels or 16384 on a side.
ImageSize probe_image(const std::string& file, const std::string& place, const Bytes& bytes);

/// RGBA8 texels, row 0 at the top. Throws InputError. Thread-safe.
std::vector<std::uint8_t> decode_image(const std::string& file, const std::string& place, const Bytes& bytes,
                                       ImageSize size);

}  // namespace ir::scene::gltf
