#include "renderers/passes/ldm/host/kept_maps.h"

#include "renderers/graph/pass_context.h"

namespace ir::passes::ldm {

std::span<const StreamedMap> KeptMaps::get(const HostScene& scene, const Maps& maps, std::int64_t first,
                                           std::int64_t end, int row, BuildScratch& scratch,
                                           std::uint64_t& built) {
    const auto start = static_cast<std::size_t>(row / rows_) * count_;
    const int rows = std::min(rows_, maps.layout.resolution - row);
    for (auto map = static_cast<std::size_t>(first); map < static_cast<std::size_t>(end); ++map)
        std::call_once(built_[start + map], [&] {
            const auto before = scratch.fragments_made;
            build_map(scene.meshlets, scene.masks, maps.frames[map], row, rows, bands_[start + map], scratch);
            fragments_[start + map] = scratch.fragments_made - before;
            scratch.fragments_made = before;
            built += row == 0;
        });
    for (auto map = first; map < end; ++map)
        scratch.fragments_made += fragments_[start + static_cast<std::size_t>(map)];
    return std::span(bands_).subspan(start + static_cast<std::size_t>(first),
                                     static_cast<std::size_t>(end - first));
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
