#include "renderers/passes/ldm/storages.h"

namespace ir::passes::ldm {
namespace {

/// Arrays of Layout::fixed_layers depths per texel, of 16 bits each. What does not fit is dropped and
/// counted. [Bavoil07, Liu10]
class FixedStorage : public Storage {
  public:
    FixedStorage(graph::GraphBuilder& builder, const Layout& layout, FixedOrder order)
        : Storage(layout), order_(order) {
        depths_ = declare(
            builder, {.text = {.key = "ldm.fixed_depths",
                               .label = "Depths",
                               .doc = "Sorted depths in quanta, as many for each texel; two per word, 65535 "
                                      "where there is none.",
                               .semantic = Semantic::depth},
                      .name = "LdmFixedDepths",
                      .fields = {{"pair", graph::FieldType::u32}},
                      .elements = layout.batch_maps * layout.map_texels() * texel_words()});
        chunk_ = declare(
            builder,
            {.text =
                 {.key = "ldm.fixed_chunk",
                  .label = "Depths of a chunk",
                  .doc =
                      "65535 - depth of the chunk that was built last, texel by texel; 0 where there is none."},
             .name = "LdmFixedChunk",
             .fields = {{"nearness", graph::FieldType::u32}},
             .elements =
                 layout.chunk_maps * layout.map_texels() * static_cast<std::uint64_t>(layout.fixed_layers)});
    }

    std::map<std::string, std::string> defines(const graph::PassContext&) const override {
        return {{"LDM_FIXED", "1"}, {"LDM_FIXED_LAYERS", std::to_string(layout_.fixed_layers) + "u"}};
    }
    std::vector<graph::BufferRef> buffers() const override { return {depths_}; }
    std::vector<graph::BufferRef> scratch() const override { return {chunk_}; }
    std::vector<graph::CounterRef> counters() const override { return {}; }
    bool needs_arrivals() const override { return order_ == FixedOrder::after; }
    void begin_batch(const graph::PassContext&) const override {}
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override {
        context.clear(chunk_);
        gl::ProgramSource place{{"passes/ldm/fixed_place.comp"}}, pack{{"passes/ldm/fixed_pack.comp"}};
        if (order_ == FixedOrder::arrival)
            place.defines["FIXED_PRESORTED"] = pack.defines["FIXED_PRESORTED"] = "1";
        for (auto* source : {&place, &pack})
            source->defines["FIXED_LAYERS"] = std::to_string(layout_.fixed_layers) + "u";
        pack.defines["FIXED_NETWORK"] = layout_.fixed_layers > 16 && layout_.fixed_layers <= 32 ? "32" : "16";
        context.use(place);
        dispatch_indirect(context, list.state, fragment_groups_word);
        context.barrier();
        const auto& packing = context.use(pack);
        const auto constants = chunk_constants(chunk, layout_);
        packing.set(constants);
        packing.dispatch(constants.texel_count);
        context.barrier();
    }
    std::uint64_t table_bytes(const graph::PassContext&) const override {
        return layout_.batch_maps * layout_.map_texels() * texel_words() * 4;
    }
    double fragment_bytes() const override { return 0; }

  private:
    std::uint64_t texel_words() const { return static_cast<std::uint64_t>(layout_.fixed_layers + 1) / 2; }

    FixedOrder order_;
    graph::BufferRef depths_, chunk_;
};

}  // namespace

StoragePointer make_fixed_arrays(graph::GraphBuilder& builder, const Layout& layout, FixedOrder order) {
    return std::make_shared<FixedStorage>(builder, layout, order);
}

}  // namespace ir::passes::ldm
