#include "renderers/passes/ldm/packed_storage.h"

namespace ir::passes::ldm {
namespace {

/// Constants of packed_builder.glsl.
struct PackChunk {
    ChunkConstants chunk;
    unsigned table_words;
    IR_FIELDS(chunk, table_words)
};

/// Layout of the arrays that hold one chunk.
Layout chunk_layout(Layout layout) {
    layout.batch_maps = layout.chunk_maps;
    return layout;
}

}  // namespace

PackedStorage::PackedStorage(graph::GraphBuilder& builder, const Layout& layout)
    : layout_(layout), chunk_(builder, chunk_layout(layout), ArrayStorage::Holds::one_chunk) {
    using graph::FieldType;
    const std::uint64_t texels = layout.batch_maps * layout.map_texels();
    rows_ = builder.buffer({.text = {.key = "ldm.packed_rows",
                                     .label = "Rows of texels",
                                     .doc = "Number of the first depth of each row of texels."},
                            .name = "LdmPackedRows",
                            .fields = {{"first", FieldType::u32}},
                            .elements = batch_rows(),
                            .fingerprint = layout.fingerprint});
    groups_ = builder.buffer({.text = {.key = "ldm.packed_groups",
                                       .label = "Groups of texels",
                                       .doc = "Per eight texels of a row where their first depth is, counted "
                                              "from the row's (16 bits), and numbers of depths (6 bits "
                                              "each); at the end, nine words for each group with more."},
                              .name = "LdmGroups",
                              .fields = {{"word", FieldType::u32}},
                              .elements = table_words() + table_words() / 64,
                              .growable = true,
                              .fingerprint = layout.fingerprint});
    depths_ = builder.buffer({.text = {.key = "ldm.packed_depths",
                                       .label = "Packed depths",
                                       .doc = "Sorted depths, texel by texel, 11 bits each; 32 of them fill "
                                              "11 words.",
                                       .semantic = Semantic::depth},
                              .name = "LdmPackedDepths",
                              .fields = {{"word", FieldType::u32}},
                              .elements = texels * expected_layers * packed_bits / 32,
                              .growable = true,
                              .fingerprint = layout.fingerprint});
    texels_ = builder.buffer({.text = {.key = "ldm.packed_texels",
                                       .label = "Texels of a chunk",
                                       .doc = "Number of the first packed depth of each texel of the chunk "
                                              "that was built last."},
                              .name = "LdmPackedTexels",
                              .fields = {{"first", FieldType::u32}},
                              .elements = layout.chunk_maps * layout.map_texels() + 1,
                              .fingerprint = layout.fingerprint});
    depth_words_requested_ = builder.counter({.key = "ldm.packed_depth_words",
                                              .name = "DepthWordsRequested",
                                              .label = "Words of packed depths",
                                              .doc = "Of the largest batch of maps.",
                                              .growth_of = depths_});
    group_words_requested_ = builder.counter({.key = "ldm.packed_group_words",
                                              .name = "GroupWordsRequested",
                                              .label = "Words of groups of texels",
                                              .doc = "Of the largest batch of maps.",
                                              .growth_of = groups_});
    merged_ = builder.counter({.key = "ldm.merged",
                               .name = "Merged",
                               .label = "Merged fragments",
                               .doc = "Whose depth equals another's of the texel once it is rounded."});
}

std::map<std::string, std::string> PackedStorage::defines(const graph::PassContext& context) const {
    // Half of what is rounded away, and one quantum for rasterisation.
    std::map<std::string, std::string> result{
        {"LDM_PACKED_BITS", std::to_string(packed_bits)},
        {"LDM_ROUNDING", std::to_string((1 << (15 - packed_bits)) + 1) + ".0"}};
    // Before it has grown the table may be too small for any query.
    if (context.capacity(groups_) < table_words()) result["LDM_EMPTY"] = "1";
    return result;
}

std::vector<graph::BufferRef> PackedStorage::scratch() const {
    auto result = chunk_.buffers();
    for (const auto buffer : chunk_.scratch()) result.push_back(buffer);
    result.push_back(texels_);
    return result;
}

std::vector<graph::CounterRef> PackedStorage::counters() const {
    auto result = chunk_.counters();
    for (const auto counter : {depth_words_requested_, group_words_requested_, merged_})
        result.push_back(counter);
    return result;
}

void PackedStorage::begin_batch(const graph::PassContext& context) const {
    context.clear(depths_);
}

void PackedStorage::store(const graph::PassContext& context, const FragmentList& list,
                          const Chunk& chunk) const {
    chunk_.store(context, list, {0, chunk.maps});
    const PackChunk constants{chunk_constants(chunk, layout_), static_cast<unsigned>(table_words())};
    const auto run = [&](const char* file, std::int64_t invocations) {
        gl::ProgramSource source{{file}};
        source.defines["LDM_PACKED_BITS"] = std::to_string(packed_bits);
        const auto& program = context.use(source);
        program.set(constants);
        program.dispatch(invocations);
        context.barrier();
    };
    run("passes/ldm/packed_count.comp", constants.chunk.texel_count);
    run("passes/ldm/packed_rows.comp", constants.chunk.row_count);
    run("passes/ldm/packed_bases.comp", 1);
    run("passes/ldm/packed_groups.comp", constants.chunk.row_count);
    run("passes/ldm/packed_write.comp", constants.chunk.texel_count);
}

std::uint64_t PackedStorage::table_bytes(const graph::PassContext&) const {
    return 4 * (batch_rows() + table_words());
}

}  // namespace ir::passes::ldm
