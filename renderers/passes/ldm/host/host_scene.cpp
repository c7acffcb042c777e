#include "renderers/passes/ldm/host/host_scene.h"

#include <tbb/info.h>

#include <optional>

#include "renderers/graph/declared.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/ldm/coarse_scene.h"

namespace ir::passes::ldm {

int host_threads(const graph::FrameInputs& inputs) {
    return inputs.threads > 0 ? inputs.threads : tbb::info::default_concurrency();
}

void HostCounters::report(const graph::PassContext& context, const Layout& layout,
                          const std::vector<HostWork>& threads) const {
    HostWork all;
    for (const auto& each : threads) {
        all.fragments += each.fragments;
        all.bytes += each.bytes;
        all.build_ms += each.build_ms / static_cast<double>(threads.size());
        all.query_ms += each.query_ms / static_cast<double>(threads.size());
    }
    context.add(fragments, static_cast<std::uint32_t>(all.fragments));
    context.add(texels, static_cast<std::uint32_t>(layout.map_texels() * layout.maps));
    context.add(bytes, static_cast<std::uint32_t>(all.bytes));
    context.notes().set_figure("ldm.build_ms", all.build_ms);
    context.notes().set_figure("ldm.query_ms", all.query_ms);
}

HostCounters declare_host_counters(graph::GraphBuilder& builder) {
    return {builder.counter({.key = "ldm.fragments",
                             .label = "Fragments",
                             .doc = "Made by rasterising the scene into all maps."}),
            builder.counter({.key = "ldm.texels", .label = "Texels", .doc = "Of all maps."}),
            builder.counter({.key = "ldm.bytes",
                             .label = "Memory of maps",
                             .doc = "Bytes that the maps take which are in memory at once, and "
                                    "building them."})};
}

graph::ObjectRef declare_meshlets(graph::GraphBuilder& builder, float detail) {
    graph::ObjectDesc desc;
    desc.text.key = "ldm.meshlets";
    if (const auto found = graph::declared_object(builder, desc.text.key)) return *found;
    desc.text.label = "Meshlets";
    desc.text.doc = "The scene's triangles in groups that lie together, for maps that are built on the host.";
    std::optional<graph::ObjectRef> coarse;
    if (detail < 1) coarse = coarse_world(builder, detail);
    desc.fingerprint = coarse ? builder.objects()[static_cast<std::size_t>(coarse->index)].fingerprint
                              : builder.inputs().geometry_fingerprint;
    const auto result = builder.object(desc);
    auto pass = builder.pass("meshlets", graph::Queue::cpu);
    if (coarse) pass.reads(*coarse);
    pass.writes(result).execute([result, coarse](graph::PassContext& context) {
        const auto& inputs = context.inputs();
        const auto simplified = coarse ? context.object<scene::World>(*coarse) : nullptr;
        const auto& world = simplified ? *simplified : *inputs.world;
        const auto made = std::make_shared<HostScene>(
            HostScene{make_meshlets(world, inputs.threads), AlphaMasks(*inputs.scene, world)});
        context.store(result, made, made->meshlets.bytes() + made->masks.bytes());
    });
    return result;
}

}  // namespace ir::passes::ldm
