#include "renderers/passes/raytracing/alpha_masks.h"

namespace ir::passes {
namespace {

std::int32_t bitmap_of(const scene::World& world, int material) {
    for (std::size_t i = 0; i < world.opacity.size(); ++i) {
        if (world.opacity[i].material == material) return static_cast<std::int32_t>(i);
    }
    return -1;
}

}  // namespace

AlphaMasks::AlphaMasks(const scene::Scene& scene, const scene::World& world) {
    bitmaps_.opacity = world.opacity;
    bitmaps_.opacity_words = world.opacity_words;
    for (const auto& texture : scene.textures) samplers_.push_back(texture.sampler);
    samplers_.emplace_back();  // for masks without a texture
    for (std::size_t i = world.opaque_triangles; i < world.triangles(); ++i) {
        triangles_.push_back(make_triangle(scene, world, i));
    }
}

AlphaMasks::Triangle AlphaMasks::make_triangle(const scene::Scene& scene, const scene::World& world,
                                               std::size_t index) const {
    const auto material = world.triangle_materials.at(index);
    const auto& slot = scene.materials.at(material).base_colour_texture;
    const auto& uvs = slot.uv_set == 1 ? world.uv1 : world.uv0;
    Triangle result;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const auto vertex = world.indices[3 * index + corner];
        result.uv[corner] = vertex < uvs.size() ? scene::transformed_uv(slot, uvs[vertex]) : glm::vec2(0);
    }
    result.bitmap = bitmap_of(world, static_cast<int>(material));
    result.sampler = slot.texture >= 0 ? slot.texture : static_cast<std::int32_t>(scene.textures.size());
    return result;
}

bool AlphaMasks::is_covered(std::uint32_t triangle, float u, float v) const {
    const auto& t = triangles_[triangle];
    if (t.bitmap < 0) return true;
    const auto uv = (1 - u - v) * t.uv[0] + u * t.uv[1] + v * t.uv[2];
    const auto& bitmap = bitmaps_.opacity[static_cast<std::size_t>(t.bitmap)];
    return scene::is_covered(bitmaps_, bitmap, samplers_[static_cast<std::size_t>(t.sampler)], uv);
}

std::uint64_t AlphaMasks::bytes() const {
    return triangles_.size() * sizeof(Triangle) + bitmaps_.opacity_words.size() * sizeof(std::uint32_t);
}

}  // namespace ir::passes
