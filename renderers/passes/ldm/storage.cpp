#include "renderers/passes/ldm/storage.h"

#include <stdexcept>

#include "renderers/passes/ldm/storages.h"

namespace ir::passes::ldm {

ChunkConstants chunk_constants(const Chunk& chunk, const Layout& layout) {
    return {.batch_texel = static_cast<unsigned>(chunk.first_map * layout.map_texels()),
            .texel_count = static_cast<unsigned>(chunk.maps * layout.map_texels()),
            .first_row = static_cast<unsigned>(chunk.first_map * layout.resolution),
            .row_count = static_cast<unsigned>(chunk.maps * layout.resolution),
            .resolution = static_cast<unsigned>(layout.resolution)};
}

bool may_keep_slopes(StorageKind kind) {
    return kind == StorageKind::arrays || kind == StorageKind::packed_arrays;
}

std::map<std::string, std::string> node_defines(const Layout& layout) {
    if (!layout.keeps_slopes()) return {};
    return {{"LDM_SLOPES", "1"}};
}

graph::BufferRef Storage::declare(graph::GraphBuilder& builder, graph::BufferDesc desc) const {
    desc.fingerprint = layout_.fingerprint;
    return builder.buffer(std::move(desc));
}

graph::CounterRef count_requested(graph::GraphBuilder& builder, const std::string& key,
                                  const std::string& name, const std::string& label,
                                  graph::BufferRef buffer) {
    return builder.counter({.key = key,
                            .name = name,
                            .label = label,
                            .doc = "Of the largest batch of maps.",
                            .growth_of = buffer});
}

std::shared_ptr<const Storage> make_storage(graph::GraphBuilder& builder, StorageKind kind,
                                            const Layout& layout) {
    switch (kind) {
        case StorageKind::linked_lists:
            return make_lists(builder, layout);
        case StorageKind::arrays:
            return make_arrays(builder, layout);
        case StorageKind::sparse_arrays:
            return make_sparse_arrays(builder, layout);
        case StorageKind::fixed_arrays:
            return make_fixed_arrays(builder, layout, FixedOrder::after);
        case StorageKind::fixed_arrays_presorted:
            return make_fixed_arrays(builder, layout, FixedOrder::arrival);
        case StorageKind::hash:
            return make_hash_table(builder, layout);
        case StorageKind::depth_peeling:
            return make_planes(builder, layout);
        case StorageKind::lists_then_sort:
            return make_sorted_lists(builder, layout);
        case StorageKind::pages:
            return make_pages(builder, layout);
        case StorageKind::outermost:
            return make_outermost(builder, layout);
        case StorageKind::packed_arrays:
            return make_packed_arrays(builder, layout);
    }
    throw std::logic_error("unknown storage of layered depth maps");
}

void dispatch_indirect(const graph::PassContext& context, graph::BufferRef state, int word) {
    const auto& gl = context.api();
    gl.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, context.buffer(state));
    gl.DispatchComputeIndirect(word * 4);
    gl.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

}  // namespace ir::passes::ldm
