#include "renderers/passes/ldm/hash_storage.h"

namespace ir::passes::ldm {
namespace {

/// Cells per texel before the scene is known. Fewer than for other storages: spare cells are not kept for
/// later, every search passes them.
constexpr int expected_cells = 5;

/// Constants of hash_count.comp.
struct HashCount {
    unsigned min_cells;
    IR_FIELDS(min_cells)
};

}  // namespace

HashStorage::HashStorage(graph::GraphBuilder& builder, const Layout& layout) : layout_(layout) {
    using graph::FieldType;
    ages_ = builder.buffer({.text = {.key = "ldm.ages",
                                     .label = "Largest ages",
                                     .doc = "Age of each texel's oldest entry; 0: the texel is empty.",
                                     .semantic = Semantic::count},
                            .name = "LdmAges",
                            .fields = {{"age", FieldType::u32}},
                            .elements = batch_texels(),
                            .fingerprint = layout.fingerprint});
    cells_ = builder.buffer({.text = {.key = "ldm.cells",
                                      .label = "Hash table",
                                      .doc = "Age << 16 | 65535 - depth in quanta; 0: empty."},
                             .name = "LdmCells",
                             .fields = {{"entry", FieldType::u32}},
                             .elements = batch_texels() * expected_cells,
                             .growable = true,
                             .fingerprint = layout.fingerprint});
    cells_requested_ = builder.counter({.key = "ldm.hash_cells",
                                        .name = "CellsRequested",
                                        .label = "Cells of the hash table",
                                        .doc = "That the largest batch of maps needs to fill 9/10 of them.",
                                        .growth_of = cells_});
    max_age_ = builder.counter({.key = "ldm.max_age",
                                .name = "MostAge",
                                .label = "Largest age",
                                .doc = "Of all entries of the hash table: turns of the longest search."});
}

std::map<std::string, std::string> HashStorage::defines(const graph::PassContext& context) const {
    std::map<std::string, std::string> result{{"LDM_HASH", "1"}};
    if (is_too_small(context)) result["LDM_EMPTY"] = "1";
    return result;
}

void HashStorage::begin_batch(const graph::PassContext& context) const {
    context.clear(ages_);
    context.clear(cells_);
}

void HashStorage::store(const graph::PassContext& context, const FragmentList& list,
                        const Chunk& chunk) const {
    if (!is_too_small(context)) {
        const auto& insert = context.use({{"passes/ldm/hash_insert.comp"}});
        insert.set(chunk_constants(chunk, layout_));
        dispatch_indirect(context, list.state, fragment_groups_word);
        context.barrier();
    }
    const auto& count = context.use({{"passes/ldm/hash_count.comp"}});
    count.set(HashCount{static_cast<unsigned>(batch_texels())});
    count.dispatch(1);
    context.barrier();
}

std::uint64_t HashStorage::table_bytes(const graph::PassContext& context) const {
    return 4 * (batch_texels() + context.capacity(cells_));
}

}  // namespace ir::passes::ldm
