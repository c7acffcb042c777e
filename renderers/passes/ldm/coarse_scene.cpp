// Maps of a coarser scene: rays still start from the scene's own surfaces. [Tokuyoshi12, Aalund15 §2.1]
#include "renderers/passes/ldm/coarse_scene.h"

#include <algorithm>
#include <sstream>

#include "renderers/graph/declared.h"
#include "renderers/graph/pass_context.h"
#include "renderers/scene/coarser.h"

namespace ir::passes::ldm {
namespace {

std::string fingerprint_of(const graph::GraphBuilder& builder, float detail) {
    const auto& geometry = builder.inputs().geometry_fingerprint;
    if (geometry.empty()) return {};
    std::ostringstream text;
    text << geometry << " detail " << std::hexfloat << detail;
    return text.str();
}

/// The simplified triangles, then some without area in place of the rest, then the masked ones.
void write_triangles(const scene::World& world, const scene::World& coarse,
                     std::span<std::uint32_t> indices) {
    const auto masked = static_cast<std::ptrdiff_t>(3 * std::size_t{world.opaque_triangles});
    const auto kept = static_cast<std::ptrdiff_t>(3 * std::size_t{coarse.opaque_triangles});
    const auto end = std::copy_n(coarse.indices.begin(), kept, indices.begin());
    std::fill(end, indices.begin() + masked, 0u);
    std::copy(coarse.indices.begin() + kept, coarse.indices.end(), indices.begin() + masked);
}

}  // namespace

graph::ObjectRef coarse_world(graph::GraphBuilder& builder, float detail) {
    graph::ObjectDesc desc;
    desc.text.key = "ldm.coarse_world";
    if (const auto found = graph::declared_object(builder, desc.text.key)) return *found;
    desc.text.label = "Coarser scene";
    desc.text.doc = "The scene's triangles, simplified, for maps.";
    desc.fingerprint = fingerprint_of(builder, detail);
    const auto result = builder.object(desc);
    builder.pass("simplify scene", graph::Queue::cpu)
        .writes(result)
        .execute([result, detail](graph::PassContext& context) {
            const auto made = std::make_shared<scene::World>(scene::coarser(*context.inputs().world, detail));
            context.store(result, made, scene::memory_bytes(*made));
        });
    return result;
}

SceneBuffers map_scene(graph::GraphBuilder& builder, const SceneBuffers& scene, float detail) {
    if (detail >= 1) return scene;
    auto result = scene;
    const auto coarse = coarse_world(builder, detail);
    result.indices =
        builder.buffer({.text = {.key = "ldm.coarse_triangles",
                                 .label = "Triangles of the coarser scene",
                                 .doc = "As many as of the scene; those left over have no area."},
                        .name = "SceneIndices",
                        .fields = {{"vertex", graph::FieldType::u32, 3}},
                        .elements = builder.inputs().world->triangles(),
                        .fingerprint = fingerprint_of(builder, detail)});
    builder.pass("coarse triangles", graph::Queue::cpu)
        .reads(coarse)
        .writes(result.indices)
        .execute([coarse, indices = result.indices](graph::PassContext& context) {
            write_triangles(*context.inputs().world, *context.object<scene::World>(coarse),
                            context.elements<std::uint32_t>(indices));
        });
    return result;
}

}  // namespace ir::passes::ldm
