#include "renderers/passes/ldm/fixed_storage.h"

namespace ir::passes::ldm {

FixedStorage::FixedStorage(graph::GraphBuilder& builder, const Layout& layout, FixedOrder order)
    : layout_(layout), order_(order) {
    depths_ = builder.buffer(
        {.text = {.key = "ldm.fixed_depths",
                  .label = "Depths",
                  .doc = "Sorted depths in quanta, as many for each texel; two per word, 65535 "
                         "where there is none.",
                  .semantic = Semantic::depth},
         .name = "LdmFixedDepths",
         .fields = {{"pair", graph::FieldType::u32}},
         .elements = layout.batch_maps * layout.map_texels() * texel_words(),
         .fingerprint = layout.fingerprint});
    chunk_ = builder.buffer(
        {.text =
             {.key = "ldm.fixed_chunk",
              .label = "Depths of a chunk",
              .doc =
                  "65535 - depth of the chunk that was built last, texel by texel; 0 where there is none."},
         .name = "LdmFixedChunk",
         .fields = {{"nearness", graph::FieldType::u32}},
         .elements =
             layout.chunk_maps * layout.map_texels() * static_cast<std::uint64_t>(layout.fixed_layers),
         .fingerprint = layout.fingerprint});
}

std::map<std::string, std::string> FixedStorage::defines(const graph::PassContext&) const {
    return {{"LDM_FIXED", "1"}, {"LDM_FIXED_LAYERS", std::to_string(layout_.fixed_layers) + "u"}};
}

void FixedStorage::store(const graph::PassContext& context, const FragmentList& list,
                         const Chunk& chunk) const {
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

std::uint64_t FixedStorage::table_bytes(const graph::PassContext&) const {
    return layout_.batch_maps * layout_.map_texels() * texel_words() * 4;
}

}  // namespace ir::passes::ldm
