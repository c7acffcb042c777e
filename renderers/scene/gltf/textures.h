#pragma once

#include <vector>

#include "renderers/scene/gltf/document.h"
#include "renderers/scene/scene.h"

namespace ir::scene::gltf {

/// The textures that materials use: one per image, sampler and encoding.
class TextureTable {
  public:
    explicit TextureTable(Document& document) : document_(document) {}
    /// Index into Scene::textures; -1 (with a warning) where the texture has no image in a core format.
    int add(int texture, bool srgb);
    /// Decodes all images that were added, on all cores. Throws InputError.
    std::vector<Texture> decode() const;

  private:
    struct Request {
        int image = 0;
        Sampler sampler;
        bool srgb = false;
        std::string name;
    };
    std::vector<std::vector<std::uint8_t>> decode_images(std::vector<std::size_t> wanted) const;

    Document& document_;
    std::vector<Request> requests_;
};

}  // namespace ir::scene::gltf
