#include "renderers/passes/ldm/storage.h"

#include <stdexcept>

#include "renderers/passes/ldm/array_storage.h"
#include "renderers/passes/ldm/fixed_storage.h"
#include "renderers/passes/ldm/hash_storage.h"
#include "renderers/passes/ldm/list_storage.h"
#include "renderers/passes/ldm/outermost_storage.h"
#include "renderers/passes/ldm/packed_storage.h"
#include "renderers/passes/ldm/page_storage.h"
#include "renderers/passes/ldm/peel_storage.h"
#include "renderers/passes/ldm/sorted_list_storage.h"
#include "renderers/passes/ldm/sparse_storage.h"

namespace ir::passes::ldm {

ChunkConstants chunk_constants(const Chunk& chunk, const Layout& layout) {
    return {.batch_texel = static_cast<unsigned>(chunk.first_map * layout.map_texels()),
            .texel_count = static_cast<unsigned>(chunk.maps * layout.map_texels()),
            .first_row = static_cast<unsigned>(chunk.first_map * layout.resolution),
            .row_count = static_cast<unsigned>(chunk.maps * layout.resolution),
            .resolution = static_cast<unsigned>(layout.resolution)};
}

std::shared_ptr<const Storage> make_storage(graph::GraphBuilder& builder, StorageKind kind,
                                            const Layout& layout) {
    switch (kind) {
        case StorageKind::linked_lists:
            return std::make_shared<ListStorage>(builder, layout);
        case StorageKind::arrays:
            return std::make_shared<ArrayStorage>(builder, layout);
        case StorageKind::sparse_arrays:
            return std::make_shared<SparseStorage>(builder, layout);
        case StorageKind::fixed_arrays:
            return std::make_shared<FixedStorage>(builder, layout, FixedOrder::after);
        case StorageKind::fixed_arrays_presorted:
            return std::make_shared<FixedStorage>(builder, layout, FixedOrder::arrival);
        case StorageKind::hash:
            return std::make_shared<HashStorage>(builder, layout);
        case StorageKind::depth_peeling:
            return std::make_shared<PeelStorage>(builder, layout);
        case StorageKind::lists_then_sort:
            return std::make_shared<SortedListStorage>(builder, layout);
        case StorageKind::pages:
            return std::make_shared<PageStorage>(builder, layout);
        case StorageKind::outermost:
            return std::make_shared<OutermostStorage>(builder, layout);
        case StorageKind::packed_arrays:
            return std::make_shared<PackedStorage>(builder, layout);
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
