#include "renderers/passes/ldm/storages.h"

namespace ir::passes::ldm {
namespace {

constexpr int expected_deepest = 64;  ///< layers of the deepest texel

/// Constants of peel_builder.glsl.
struct PeelChunk {
    ChunkConstants place;
    unsigned chunk, plane_texels, plane_room;
    IR_FIELDS(place, chunk, plane_texels, plane_room)
};

/// Constants of peel.comp.
struct Peel {
    PeelChunk chunk;
    unsigned plane;
    IR_FIELDS(chunk, plane)
};

/// Depth peeling: plane by plane the nearest fragment of each texel beyond that of the plane before, as many
/// planes for each chunk of maps as its deepest texel has layers. [Everitt01]
///
/// DEVIATION [Everitt01]: a plane is a pass over the chunk's fragments, not another drawing of the scene, so
/// that all storages hold the same fragments; and the order of arrival tells fragments of equal depth apart,
/// which peeling by depth alone would lose.
class PeelStorage : public Storage {
  public:
    PeelStorage(graph::GraphBuilder& builder, const Layout& layout) : Storage(layout) {
        using graph::FieldType;
        chunks_ = declare(
            builder,
            {.text = {.key = "ldm.peeled_chunks",
                      .label = "Peeled chunks",
                      .doc = "First entry in the planes of each chunk of maps, its planes, "
                             "and the entry after its last, also beyond capacity."},
             .name = "LdmPeeledChunks",
             .fields = {{"first", FieldType::u32}, {"planes", FieldType::u32}, {"end", FieldType::u32}},
             .elements = batch_chunks()});
        planes_ = declare(
            builder, {.text = {.key = "ldm.planes",
                               .label = "Planes",
                               .doc = "By chunk, plane and texel: 2^32 - 1 - (depth in quanta << 16 | order "
                                      "of arrival), 0 where there is no further layer.",
                               .semantic = Semantic::depth},
                      .name = "LdmPlanes",
                      .fields = {{"fragment", FieldType::u32}},
                      .elements = batch_chunks() * plane_texels() * expected_layers,
                      .growable = true});
        layers_ = declare(
            builder, {.text = {.key = "ldm.peeled_layers",
                               .label = "Peeled layers",
                               .doc = "Work groups that peel each plane of the chunk that was built last."},
                      .name = "LdmPeeledLayers",
                      .fields = {{"groups_x", FieldType::u32},
                                 {"groups_y", FieldType::u32},
                                 {"groups_z", FieldType::u32}},
                      .elements = expected_deepest,
                      .growable = true});
        layers_requested_ = builder.counter({.key = "ldm.max_layers",
                                             .name = "LayersRequested",
                                             .label = "Maximum layers",
                                             .doc = "Of the deepest texel.",
                                             .growth_of = layers_});
        planes_requested_ =
            count_requested(builder, "ldm.plane_entries", "PlanesRequested", "Entries of planes", planes_);
    }

    std::map<std::string, std::string> defines(const graph::PassContext&) const override {
        return {{"LDM_PEELED", "1"},
                {"LDM_CHUNK_MAPS", std::to_string(layout_.chunk_maps) + "u"},
                {"LDM_PLANE_TEXELS", std::to_string(plane_texels()) + "u"}};
    }
    std::vector<graph::BufferRef> buffers() const override { return {chunks_, planes_}; }
    std::vector<graph::BufferRef> scratch() const override { return {layers_}; }
    std::vector<graph::CounterRef> counters() const override {
        return {layers_requested_, planes_requested_};
    }
    bool needs_arrivals() const override { return true; }
    void begin_batch(const graph::PassContext& context) const override {
        context.clear(chunks_);
        context.clear(planes_);
    }
    void store(const graph::PassContext& context, const FragmentList&, const Chunk& chunk) const override {
        const PeelChunk constants{
            chunk_constants(chunk, layout_), static_cast<unsigned>(chunk.first_map / layout_.chunk_maps),
            static_cast<unsigned>(plane_texels()), static_cast<unsigned>(context.capacity(planes_))};
        const auto planes = static_cast<int>(context.capacity(layers_));
        const auto run = [&](const char* file, std::int64_t invocations) {
            run_program(context, {{file}}, constants, invocations);
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
    /// Planes have as many texels as a chunk of maps, whatever the chunk has. They are counted by chunk, as
    /// their number is only known then.
    std::uint64_t table_bytes(const graph::PassContext&) const override { return batch_chunks() * 12; }
    double fragment_bytes() const override { return 0; }

  private:
    std::uint64_t batch_chunks() const {
        return static_cast<std::uint64_t>((layout_.batch_maps + layout_.chunk_maps - 1) / layout_.chunk_maps);
    }
    std::uint64_t plane_texels() const { return layout_.chunk_maps * layout_.map_texels(); }

    graph::BufferRef chunks_, planes_, layers_;
    graph::CounterRef layers_requested_, planes_requested_;
};

}  // namespace

StoragePointer make_planes(graph::GraphBuilder& builder, const Layout& layout) {
    return std::make_shared<PeelStorage>(builder, layout);
}

}  // namespace ir::passes::ldm
