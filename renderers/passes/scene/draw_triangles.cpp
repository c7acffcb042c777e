#include "renderers/passes/scene/draw_triangles.h"

namespace ir::passes {
namespace {

struct NamedSlot {
    const char* name;
    scene::TextureSlot scene::Material::*slot;
};
constexpr NamedSlot slots[] = {{"base_colour_texture", &scene::Material::base_colour_texture},
                               {"metallic_roughness_texture", &scene::Material::metallic_roughness_texture},
                               {"normal_texture", &scene::Material::normal_texture},
                               {"emission_texture", &scene::Material::emission_texture},
                               {"transmission_texture", &scene::Material::transmission_texture}};

}  // namespace

void reads_triangles(graph::PassBuilder& pass, const SceneBuffers& s) {
    pass.reads(s.positions, s.normals, s.tangents, s.uv0, s.uv1, s.colours, s.to_previous, s.indices,
               s.opacity, s.opacity_words, s.materials);
}

void reads_textures(graph::PassBuilder& pass, const SceneBuffers& s) {
    for (const auto texture : s.textures) pass.reads(texture);
    for (const auto& slot : slots) pass.reads(slot.name, graph::ImageRef{});
}

int bind_textures(const graph::PassContext& p, const SceneBuffers& s, const scene::Material& material) {
    int bound = 0, bit = 1;
    for (const auto& [name, slot] : slots) {
        if (const int texture = (material.*slot).texture; texture >= 0) {
            const auto index = static_cast<std::size_t>(texture);
            p.bind(name, s.textures.at(index), p.inputs().scene->textures.at(index).sampler);
            bound |= bit;
        }
        bit *= 2;
    }
    return bound;
}

void draw_triangles(const graph::PassContext& p, const scene::MaterialRange& range) {
    p.api().DrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * range.first_triangle),
                       static_cast<GLsizei>(3 * range.triangle_count));
}

void draw_triangles(const graph::PassContext& p, const std::vector<TriangleRun>& runs) {
    std::vector<GLint> firsts;
    std::vector<GLsizei> counts;
    for (const auto& run : runs) {
        firsts.push_back(static_cast<GLint>(3 * run.first));
        counts.push_back(static_cast<GLsizei>(3 * run.count));
    }
    if (!runs.empty())
        p.api().MultiDrawArrays(GL_TRIANGLES, firsts.data(), counts.data(),
                                static_cast<GLsizei>(runs.size()));
}

}  // namespace ir::passes
