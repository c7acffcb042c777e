#include "renderers/passes/ldm/peel_storage.h"

namespace ir::passes::ldm {
namespace {

constexpr int expected_deepest = 64;  ///< layers of the deepest texel

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
         .elements = batch_chunks()});
    planes_ = builder.buffer(
        {.text = {.key = "ldm.planes",
                  .label = "Planes",
                  .doc = "By chunk, plane and texel: 2^32 - 1 - (depth in quanta << 16 | order "
                         "of arrival), 0 where there is no further layer.",
                  .semantic = Semantic::depth},
         .name = "LdmPlanes",
         .fields = {{"fragment", FieldType::u32}},
         .elements = batch_chunks() * plane_texels() * expected_layers,
         .growable = true});
    layers_ = builder.buffer(
        {.text = {.key = "ldm.peeled_layers",
                  .label = "Peeled layers",
                  .doc = "Work groups that peel each plane of the chunk that was built last."},
         .name = "LdmPeeledLayers",
         .fields = {{"groups_x", FieldType::u32}, {"groups_y", FieldType::u32}, {"groups_z", FieldType::u32}},
         .elements = expected_deepest,
         .growable = true});
    layers_requested_ = builder.counter({.key = "ldm.max_layers",
                                         .name = "LayersAsked",
                                         .label = "Most layers",
                                         .doc = "Of the deepest texel.",
                                         .growth_of = layers_});
    planes_requested_ = builder.counter({.key = "ldm.plane_entries",
                                         .name = "PlanesAsked",
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
    const int rows = chunk.maps * layout_.resolution;
    const auto use = [&](const char* file) -> const gl::Program& {
        const auto& program = context.use({{file}});
        program.set("chunk", static_cast<unsigned>(chunk.first_map / layout_.chunk_maps));
        program.set("plane_texels", static_cast<unsigned>(plane_texels()));
        return program;
    };
    const auto& deepest = use("passes/ldm/peel_deepest.comp");
    deepest.set("row_count", static_cast<unsigned>(rows));
    deepest.set("resolution", static_cast<unsigned>(layout_.resolution));
    deepest.dispatch(rows);
    context.barrier();
    use("passes/ldm/peel_chunk.comp").dispatch(1);
    context.barrier();
    const auto planes = static_cast<int>(context.capacity(layers_));
    use("passes/ldm/peel_groups.comp").dispatch(planes);
    context.barrier();
    const auto& peel = use("passes/ldm/peel.comp");
    for (int plane = 0; plane < planes; ++plane) {
        peel.set("plane", static_cast<unsigned>(plane));
        dispatch_indirect(context, layers_, 3 * plane);
        context.barrier();
    }
}

std::uint64_t PeelStorage::table_bytes(const graph::PassContext&) const {
    return batch_chunks() * 12;
}

}  // namespace ir::passes::ldm
