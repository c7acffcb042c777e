#include "renderers/passes/surface/host_surfaces.h"

#include "renderers/graph/declared.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/surface/host_texture.h"
#include "renderers/passes/surface/surface.h"

namespace ir::passes {
namespace {

std::shared_ptr<std::vector<HostTexture>> with_all_levels(const scene::Scene& scene) {
    auto made = std::make_shared<std::vector<HostTexture>>();
    made->reserve(scene.textures.size());
    for (const auto& texture : scene.textures) made->emplace_back(texture, HostTexture::Levels::all);
    return made;
}

}  // namespace

graph::ObjectRef host_textures(graph::GraphBuilder& builder) {
    const std::string key = "scene.host_textures";
    if (const auto found = graph::declared_object(builder, key)) return *found;
    const auto result = builder.object(
        {.text = {.key = key, .label = "Textures with all levels", .doc = "What rays look up on the host."},
         .fingerprint = builder.inputs().scene->content_hash});
    builder.pass("textures for rays", graph::Queue::cpu)
        .writes(result)
        .execute([=](graph::PassContext& context) {
            const auto made = with_all_levels(*context.inputs().scene);
            std::uint64_t bytes = 0;
            for (const auto& texture : *made) bytes += texture.bytes();
            context.store(result, made, bytes);
        });
    return result;
}

graph::ObjectRef host_surfaces(graph::GraphBuilder& builder, bool normal_maps) {
    graph::ObjectDesc desc{.text = {.key = "scene.host_surfaces",
                                    .label = "Surfaces",
                                    .doc = "Triangles and materials for rays."},
                           .fingerprint = builder.inputs().geometry_fingerprint};
    if (const auto found = graph::declared_object(builder, desc.text.key)) return *found;
    const auto textures = host_textures(builder);
    if (!normal_maps && !desc.fingerprint.empty()) desc.fingerprint += " without normal maps";
    const auto result = builder.object(desc);
    builder.pass("surfaces for rays", graph::Queue::cpu)
        .reads(textures)
        .writes(result)
        .execute([=](graph::PassContext& context) {
            const auto& inputs = context.inputs();
            const auto made =
                std::make_shared<SurfaceLookup>(*inputs.scene, *inputs.world, normal_maps,
                                                context.object<std::vector<HostTexture>>(textures));
            context.store(result, made, made->bytes());
        });
    return result;
}

}  // namespace ir::passes
