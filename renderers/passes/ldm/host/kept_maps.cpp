#include "renderers/passes/ldm/host/kept_maps.h"

#include "renderers/graph/pass_context.h"

namespace ir::passes::ldm {

void KeptMaps::build(const HostScene& scene, const Maps& maps, std::int64_t map, int row,
                     BuildScratch& scratch, std::uint64_t& built) {
    const auto at = place(map, row);
    const auto before = scratch.fragments_made;
    std::call_once(built_[at], [&] {
        build_map(scene.meshlets, scene.masks, maps.frames[static_cast<std::size_t>(map)], row,
                  std::min(rows_, maps.layout.resolution - row), bands_[at], scratch);
        fragments_[at] = scratch.fragments_made - before;
        built += row == 0;
    });
    scratch.fragments_made = before + fragments_[at];
}

graph::ObjectRef declare_kept(graph::GraphBuilder& builder, const std::shared_ptr<const Maps>& maps) {
    if (maps->layout.fingerprint.empty() || KeptMaps::count(maps->layout) == 0) return {};
    graph::ObjectDesc desc;
    desc.text.key = "ldm.kept";
    desc.text.label = "Kept maps";
    desc.text.doc = "Outermost depths of maps that are queried anew while only the camera moves.";
    desc.fingerprint = maps->layout.fingerprint;
    desc.is_spare = true;
    const auto result = builder.object(desc);
    builder.pass("kept maps", graph::Queue::cpu).writes(result).execute([=](graph::PassContext& context) {
        const auto made = std::make_shared<KeptMaps>(maps->layout, context.capacity(result));
        context.store(result, made, made->bytes());
    });
    return result;
}

}  // namespace ir::passes::ldm
