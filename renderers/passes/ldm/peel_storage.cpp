#include "renderers/passes/ldm/peel_storage.h"

namespace ir::passes::ldm {
namespace {

constexpr int expected_deepest = 64;  ///< layers of the deepest texel

/// Constants of peel_builder.glsl.
struct PeelChunk {
    ChunkConstants place;
    unsigned chunk, plane_texels;
    IR_FIELDS(place, chunk, plane_texels)
};

/// Constants of peel.comp.
struct Peel {
    PeelChunk chunk;
    unsigned plane;
    IR_FIELDS(chunk, plane)
};

}  // namespace

PeelStorage::PeelStorage(graph::GraphBuilder& builder, const Layout& layout) : layout_(layout) {
    using graph::FieldType;
    chunks_ = builder.buffer(
        {.text = {.key = "ldm.peeled_chunks",
                  .label = "Peeled chunks",
                  .doc = "First entry in the planes of each chunk of maps, its planes, "
                         "and the entry after its last, also beyond capacity."},
         .name = "LdmPeeledChunks",
         .fields = {{"first", FieldType::u32}, {"planes", FieldType::u32}, {"end", FieldType::u32}},
         .elements = batch_chunks(),
         .fingerprint = layout.fingerprint});
    planes_ = builder.buffer(
        {.text = {.key = "ldm.planes",
                  .label = "Planes",
                  .doc = "By chunk, plane and texel: 2^32 - 1 - (depth in quanta << 16 | order "
                         "of arrival), 0 where there is no further layer.",
                  .semantic = Semantic::depth},
         .name = "LdmPlanes",
         .fields = {{"fragment", FieldType::u32}},
         .elements = batch_chunks() * plane_texels() * expected_layers,
         .growable = true,
         .fingerprint = layout.fingerprint});
    layers_ = builder.buffer(
        {.text = {.key = "ldm.peeled_layers",
                  .label = "Peeled layers",
                  .doc = "Work groups that peel each plane of the chunk that was built last."},
         .name = "LdmPeeledLayers",
         .fields = {{"groups_x", FieldType::u32}, {"groups_y", FieldType::u32}, {"groups_z", FieldType::u32}},
         .elements = expected_deepest,
         .growable = true,
         .fingerprint = layout.fingerprint});
    layers_requested_ = builder.counter({.key = "ldm.max_layers",
                                         .name = "LayersRequested",
                                         .label = "Maximum layers",
                                         .doc = "Of the deepest texel.",
                                         .growth_of = layers_});
    planes_requested_ = builder.counter({.key = "ldm.plane_entries",
                                         .name = "PlanesRequested",
                                         .label = "Entries of planes",
                                         .doc = "Of the largest batch of maps.",
                                         .growth_of = planes_});
}

std::map<std::string, std::string> PeelStorage::defines(const graph::PassContext&) const {
    return {{"LDM_PEELED", "1"},
            {"LDM_CHUNK_MAPS", std::to_string(layout_.chunk_maps) + "u"},
            {"LDM_PLANE_TEXELS", std::to_string(plane_texels()) + "u"}};
}

void PeelStorage::begin_batch(const graph::PassContext& context) const {
    context.clear(chunks_);
    context.clear(planes_);
}

void PeelStorage::store(const graph::PassContext& context, const FragmentList&, const Chunk& chunk) const {
    const PeelChunk constants{chunk_constants(chunk, layout_),
                              static_cast<unsigned>(chunk.first_map / layout_.chunk_maps),
                              static_cast<unsigned>(plane_texels())};
    const auto planes = static_cast<int>(context.capacity(layers_));
    const auto run = [&](const char* file, std::int64_t invocations) {
        const auto& program = context.use({{file}});
        program.set(constants);
        program.dispatch(invocations);
        context.barrier();
    };
    run("passes/ldm/peel_deepest.comp", constants.place.row_count);
    run("passes/ldm/peel_chunk.comp", 1);
    run("passes/ldm/peel_groups.comp", planes);
    const auto& peel = context.use({{"passes/ldm/peel.comp"}});
    for (int plane = 0; plane < planes; ++plane) {
        peel.set(Peel{constants, static_cast<unsigned>(plane)});
        dispatch_indirect(context, layers_, 3 * plane);
        context.barrier();
    }
}

std::uint64_t PeelStorage::table_bytes(const graph::PassContext&) const {
    return batch_chunks() * 12;
}

}  // namespace ir::passes::ldm
