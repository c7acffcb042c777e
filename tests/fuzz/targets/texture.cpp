#include "renderers/core/error.h"
#include "renderers/scene/gltf/image_file.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/targets/target.h"

using namespace ir;

/// Textures of scenes: PNG, JPEG, WebP.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const scene::gltf::Bytes bytes(data, data + size);
    try {
        const auto texels = scene::gltf::probe_image("file", "images[0]", bytes);
        if (texels.texels() > (1u << 20)) return 0;  // slow, and nothing new
        const auto rgba = scene::gltf::decode_image("file", "images[0]", bytes, texels);
        fuzz::require(rgba.size() == 4 * texels.texels(), "not four bytes for each texel");
    } catch (const InputError& error) {
        fuzz::require_one_line(error.what(), "file: images[0]: ");
    }
    return 0;
}
