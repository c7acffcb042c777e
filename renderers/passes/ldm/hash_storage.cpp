#include "renderers/passes/ldm/storages.h"

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

/// One hash table for all texels of a batch: coherent hashing, with open addressing by age. [Lefebvre13,
/// Lefebvre14 "PreOpen"] Texel t looks for its entry of age a = 1, 2, … at cell (t + offset of a) mod size,
/// so that neighbouring texels look at neighbouring cells, and cell and age tell the texel: an entry is 32
/// bits, age << 16 | nearness. A cell keeps the largest entry that comes (Robin Hood: the oldest, and of one
/// texel the nearest) and hands on the other, so each texel's depths are sorted by age as soon as they are
/// in. A table of each texel's largest age ends its searches.
///
/// The table grows when it would be fuller than 9/10. What is in excess until then is left out, the frame is
/// incomplete, and runs again.
class HashStorage : public Storage {
  public:
    HashStorage(graph::GraphBuilder& builder, const Layout& layout) : Storage(layout) {
        using graph::FieldType;
        ages_ = declare(builder, {.text = {.key = "ldm.ages",
                                           .label = "Largest ages",
                                           .doc = "Age of each texel's oldest entry; 0: the texel is empty.",
                                           .semantic = Semantic::count},
                                  .name = "LdmAges",
                                  .fields = {{"age", FieldType::u32}},
                                  .elements = batch_texels()});
        cells_ = declare(builder, {.text = {.key = "ldm.cells",
                                            .label = "Hash table",
                                            .doc = "Age << 16 | 65535 - depth in quanta; 0: empty."},
                                   .name = "LdmCells",
                                   .fields = {{"entry", FieldType::u32}},
                                   .elements = batch_texels() * expected_cells,
                                   .growable = true});
        cells_requested_ =
            builder.counter({.key = "ldm.hash_cells",
                             .name = "CellsRequested",
                             .label = "Cells of the hash table",
                             .doc = "That the largest batch of maps needs to fill 9/10 of them.",
                             .growth_of = cells_});
        max_age_ = builder.counter({.key = "ldm.max_age",
                                    .name = "MaxAge",
                                    .label = "Largest age",
                                    .doc = "Of all entries of the hash table: turns of the longest search."});
    }

    std::map<std::string, std::string> defines(const graph::PassContext& context) const override {
        std::map<std::string, std::string> result{{"LDM_HASH", "1"}};
        if (is_too_small(context)) result["LDM_EMPTY"] = "1";
        return result;
    }
    std::vector<graph::BufferRef> buffers() const override { return {ages_, cells_}; }
    std::vector<graph::CounterRef> counters() const override { return {cells_requested_, max_age_}; }
    void begin_batch(const graph::PassContext& context) const override {
        context.clear(ages_);
        context.clear(cells_);
    }
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override {
        const auto& insert = context.use({{"passes/ldm/hash_insert.comp"}});
        if (!is_too_small(context)) {
            insert.set(chunk_constants(chunk, layout_));
            dispatch_indirect(context, list.state, fragment_groups_word);
            context.barrier();
        }
        const auto& count = context.use({{"passes/ldm/hash_count.comp"}});
        count.set(HashCount{static_cast<unsigned>(batch_texels())});
        count.dispatch(1);
        context.barrier();
    }
    /// The table has no part that is spare: empty cells are what keeps searches short.
    std::uint64_t table_bytes(const graph::PassContext& context) const override {
        return 4 * (batch_texels() + context.capacity(cells_));
    }
    double fragment_bytes() const override { return 0; }

  private:
    std::uint64_t batch_texels() const { return layout_.batch_maps * layout_.map_texels(); }
    /// Fewer cells than texels could not tell texels by cell and age.
    bool is_too_small(const graph::PassContext& context) const {
        return context.capacity(cells_) < batch_texels();
    }

    graph::BufferRef ages_, cells_;
    graph::CounterRef cells_requested_, max_age_;
};

}  // namespace

StoragePointer make_hash_table(graph::GraphBuilder& builder, const Layout& layout) {
    return std::make_shared<HashStorage>(builder, layout);
}

}  // namespace ir::passes::ldm
