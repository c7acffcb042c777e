#include "renderers/passes/ldm/builder.h"

#include <algorithm>
#include <sstream>

#include "renderers/core/record.h"
#include "renderers/passes/ldm/rasterisers.h"

namespace ir::passes::ldm {
namespace {

using graph::FieldType;

/// Bounds the scratch buffers of a chunk, and keeps them within reach of caches: lists are inserted into a
/// third faster than in chunks of four times the size.
constexpr std::uint64_t chunk_texels = 8 * 200 * 200;
constexpr int max_chunk_maps = 32;  ///< bits of a word in rasterise.comp

/// Constants of prepare.comp with PREPARE_STORE and FINISH.
struct Prepare {
    unsigned fragment_bits, fragment_capacity;
    IR_FIELDS(fragment_bits, fragment_capacity)
};

/// Maps depend on the scene and their directions, and on no camera and no light.
std::string fingerprint_of(const graph::FrameInputs& inputs, const Options& options) {
    if (inputs.geometry_fingerprint.empty()) return {};
    std::ostringstream text;
    text << std::hexfloat << inputs.geometry_fingerprint << " maps " << options.directions << " x "
         << options.resolution << ' ' << static_cast<int>(options.storage) << ' '
         << static_cast<int>(options.builder) << ' ' << options.fixed_layers << ' '
         << static_cast<int>(options.nodes) << ' ' << options.detail;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) text << ' ' << options.rotation[column][row];
    return text.str();
}

Layout make_layout(graph::GraphBuilder& builder, const Options& options) {
    Layout layout;
    layout.resolution = options.resolution;
    layout.maps = options.directions;
    layout.fixed_layers = options.fixed_layers;
    layout.nodes = options.nodes;
    const int batches = builder.batches(options.directions);
    layout.batch_maps = (options.directions + batches - 1) / batches;
    const auto fitting = static_cast<int>(std::max<std::uint64_t>(1, chunk_texels / layout.map_texels()));
    layout.chunk_maps = std::min({max_chunk_maps, fitting, layout.batch_maps});
    if (layout.batches() == 1) layout.fingerprint = fingerprint_of(builder.inputs(), options);
    return layout;
}

void declare_list(graph::GraphBuilder& builder, Maps& maps) {
    const std::uint64_t texels = maps.layout.chunk_maps * maps.layout.map_texels();
    maps.list.state = builder.buffer({.text = {.key = "ldm.state",
                                               .label = "State of building",
                                               .doc = "What the steps of building tell each other."},
                                      .name = "LdmState",
                                      .fields = {{"word", FieldType::u32}},
                                      .elements = state_words,
                                      .fingerprint = maps.layout.fingerprint});
    if (maps.inserts_directly()) return;
    std::vector<graph::Field> fields{{"texel", FieldType::u32}, {"arrival_depth", FieldType::u32}};
    if (maps.layout.keeps_slopes()) fields.push_back({"slopes", FieldType::u32});
    maps.list.fragments = builder.buffer(
        {.text = {.key = "ldm.fragment_list",
                  .label = "Fragments of a chunk",
                  .doc = "Texel, order of arrival << 16 | depth in quanta, and codes of slopes if "
                         "nodes have such, of the chunk of maps that was built last."},
         .name = "LdmFragments",
         .fields = fields,
         .elements = texels * expected_layers,
         .growable = true,
         .fingerprint = maps.layout.fingerprint});
    maps.fragments_requested = builder.counter({.key = "ldm.chunk_fragments",
                                                .name = "FragmentsRequested",
                                                .label = "Fragments of the largest chunk",
                                                .growth_of = maps.list.fragments});
    if (maps.storage->needs_arrivals())
        maps.list.counts =
            builder.buffer({.text = {.key = "ldm.counts",
                                     .label = "Counts of a chunk",
                                     .doc = "Per texel of the chunk that was built last: first "
                                            "its fragments, then where they begin.",
                                     .semantic = Semantic::count},
                            .name = "LdmCounts",
                            .fields = {{"count", FieldType::u32}},
                            .elements = texels + 1,
                            .fingerprint = maps.layout.fingerprint});
    if (maps.options.builder != BuilderKind::compute) return;
    maps.large = builder.buffer({.text = {.key = "ldm.large_triangles",
                                          .label = "Strips of large triangles",
                                          .doc = "Triangle, and map | strip << 8, of the chunk of maps that "
                                                 "was built last."},
                                 .name = "LdmLarge",
                                 .fields = {{"triangle", FieldType::u32}, {"map_strip", FieldType::u32}},
                                 .elements = std::max<std::uint64_t>(1 << 16, texels / 2),
                                 .growable = true,
                                 .fingerprint = maps.layout.fingerprint});
    maps.large_requested = builder.counter({.key = "ldm.chunk_strips",
                                            .name = "LargeRequested",
                                            .label = "Strips of the largest chunk",
                                            .growth_of = maps.large});
}

bool is_fixed(StorageKind kind) {
    return kind == StorageKind::fixed_arrays || kind == StorageKind::fixed_arrays_presorted;
}

void declare_counters(graph::GraphBuilder& builder, Maps& maps) {
    maps.generated = builder.counter({.key = "ldm.fragments",
                                      .name = "Generated",
                                      .label = "Fragments",
                                      .doc = "Made by rasterising the scene into all maps."});
    maps.kept =
        builder.counter({.key = "ldm.nodes", .name = "Kept", .label = "Nodes", .doc = "Depths in all maps."});
    maps.dropped = builder.counter(
        {.key = "ldm.dropped",
         .name = "Dropped",
         .label = "Dropped fragments",
         .doc = is_fixed(maps.options.storage)
                    ? "Beyond the fixed layers of a texel: hits are missing from the picture. Raise "
                      "fixed_layers, or choose a storage without such a limit."
                    : "Beyond 60,000 layers at one texel: hits are missing from the picture.",
         .is_loss = true});
    maps.texels = builder.counter({.key = "ldm.texels", .label = "Texels", .doc = "Of all maps."});
    // A counter has 32 bits, which the bytes of all maps may exceed: each batch has its own, and the report
    // adds up those of one key.
    for (int batch = 0; batch < maps.layout.batches(); ++batch)
        maps.bytes.push_back(
            builder.counter({.key = "ldm.bytes",
                             .name = "Bytes",
                             .label = "Memory of maps",
                             .doc = "Bytes that all maps take, without spare and scratch space."}));
}

/// Builds the maps from items: each is one triangle in all maps of one chunk.
class BatchBuild {
  public:
    BatchBuild(const SceneBuffers& scene, std::shared_ptr<const Maps> maps, int batch)
        : scene_(scene), maps_(std::move(maps)), batch_(batch) {}

    /// Per chunk; one where there is no triangle, so that the maps become empty.
    static std::int64_t items(const scene::World& world) {
        return std::max<std::int64_t>(1, static_cast<std::int64_t>(world.triangles()));
    }
    std::int64_t chunks() const {
        return (maps_->batch_maps(batch_) + maps_->layout.chunk_maps - 1) / maps_->layout.chunk_maps;
    }

    void run(const graph::PassContext& context, const graph::Slice& slice) const {
        const auto triangles = items(*context.inputs().world);
        if (slice.first) {
            context.clear(maps_->list.state);
            maps_->storage->begin_batch(context);
            context.add(maps_->texels,
                        static_cast<std::uint32_t>(maps_->batch_maps(batch_) * maps_->layout.map_texels()));
            context.add(bytes(), static_cast<std::uint32_t>(maps_->storage->table_bytes(context)));
        }
        for (std::int64_t begin = slice.begin; begin < slice.end;) {
            const std::int64_t chunk = begin / triangles;
            const std::int64_t end = std::min(slice.end, (chunk + 1) * triangles);
            rasterise(context, chunk_at(chunk), begin - chunk * triangles, end - chunk * triangles);
            if (end == (chunk + 1) * triangles) finish(context, chunk_at(chunk));
            begin = end;
        }
    }

  private:
    graph::CounterRef bytes() const { return maps_->bytes[static_cast<std::size_t>(batch_)]; }

    Chunk chunk_at(std::int64_t index) const {
        const int first = static_cast<int>(index) * maps_->layout.chunk_maps;
        return {first, std::min(maps_->layout.chunk_maps, maps_->batch_maps(batch_) - first)};
    }

    void rasterise(const graph::PassContext& context, const Chunk& chunk, std::int64_t first,
                   std::int64_t end) const {
        if (first == 0 && maps_->list.counts.index >= 0) context.clear(maps_->list.counts);
        end = std::min(end, static_cast<std::int64_t>(context.inputs().world->triangles()));
        const int first_map = maps_->first_map(batch_) + chunk.first_map;
        if (maps_->options.builder == BuilderKind::raster)
            draw_triangles(context, scene_, *maps_, chunk, first_map, first, end);
        else
            dispatch_triangles(context, *maps_, chunk, first_map, first, end);
        context.barrier();
    }

    void finish(const graph::PassContext& context, const Chunk& chunk) const {
        const int first_map = maps_->first_map(batch_) + chunk.first_map;
        if (maps_->options.builder == BuilderKind::compute) {
            dispatch_large_triangles(context, *maps_, chunk, first_map);
            context.barrier();
        }
        prepare(context, "PREPARE_STORE");
        maps_->storage->store(context, maps_->list, chunk);
        prepare(context, "FINISH");
    }

    void prepare(const graph::PassContext& context, const char* step) const {
        gl::ProgramSource source{{"passes/ldm/prepare.comp"}, node_defines(maps_->layout)};
        source.defines[step] = "1";
        if (maps_->inserts_directly()) source.defines["DIRECT"] = "1";
        const auto& program = context.use(source);
        const auto fragments = maps_->list.fragments;
        program.set(Prepare{static_cast<unsigned>(8 * maps_->storage->fragment_bytes()),
                            fragments.index >= 0 ? static_cast<unsigned>(context.capacity(fragments)) : 0});
        program.dispatch(1);
        context.barrier();
    }

    SceneBuffers scene_;
    std::shared_ptr<const Maps> maps_;
    int batch_;
};

}  // namespace

std::string Maps::batch_name(int batch) const {
    if (layout.batches() == 1) return {};
    return " " + std::to_string(batch + 1) + " of " + std::to_string(layout.batches());
}

std::shared_ptr<const Maps> declare_maps(graph::GraphBuilder& builder, const Options& options) {
    auto maps = std::make_shared<Maps>();
    maps->options = options;
    maps->layout = make_layout(builder, options);
    maps->directions = leopardi_directions(options.directions);
    maps->frames =
        fit_frames(maps->directions, options.rotation, builder.inputs().world->bounds, options.resolution);
    maps->storage = make_storage(builder, options.storage, maps->layout);
    declare_list(builder, *maps);
    declare_counters(builder, *maps);
    maps->frame_buffer = builder.buffer({.text = {.key = "ldm.frames",
                                                  .label = "Views of maps",
                                                  .doc = "Orthographic view of each map: texel coordinates "
                                                         "and depth of a point, one texel's steps, direction "
                                                         "and metres per quantum of depth."},
                                         .name = "LdmFrames",
                                         .fields = record_fields<MapFrame>(),
                                         .elements = static_cast<std::uint64_t>(options.directions),
                                         .fingerprint = maps->layout.fingerprint});
    builder.pass("map frames").writes(maps->frame_buffer).execute([maps](graph::PassContext& context) {
        context.upload(maps->frame_buffer, std::as_bytes(std::span(maps->frames)));
    });
    if (maps->layout.batches() > 1)
        builder.note("the maps are built and traced in " + std::to_string(maps->layout.batches()) +
                     " batches of " + std::to_string(maps->layout.batch_maps) +
                     " to stay within the memory budget");
    return maps;
}

void build_maps(graph::GraphBuilder& builder, const SceneBuffers& scene, std::shared_ptr<const Maps> maps,
                int batch) {
    auto pass = builder.pass("build maps" + maps->batch_name(batch));
    pass.reads(maps->frame_buffer, scene.positions, scene.indices, scene.triangle_materials, scene.uv0,
               scene.uv1, scene.materials, scene.opacity, scene.opacity_words);
    for (const auto buffer : maps->storage->buffers()) pass.writes(buffer);
    for (const auto buffer : maps->storage->scratch()) pass.writes(buffer);
    for (const auto buffer : {maps->list.state, maps->list.fragments, maps->list.counts, maps->large})
        if (buffer.index >= 0) pass.writes(buffer);
    for (const auto counter : maps->storage->counters()) pass.counts(counter);
    for (const auto counter : {maps->fragments_requested, maps->large_requested, maps->generated, maps->kept,
                               maps->dropped, maps->texels, maps->bytes[static_cast<std::size_t>(batch)]})
        if (counter.index >= 0) pass.counts(counter);
    const auto triangles = BatchBuild::items(*builder.inputs().world);
    const auto build = std::make_shared<BatchBuild>(scene, maps, batch);
    pass.execute_sliced(
        build->chunks() * triangles,
        [build](graph::PassContext& context, graph::Slice slice) { build->run(context, slice); });
}

void reads_maps(graph::PassBuilder& pass, const Maps& maps) {
    pass.reads(maps.frame_buffer);
    for (const auto buffer : maps.storage->buffers()) pass.reads(buffer);
}

std::map<std::string, std::string> defines_of(const graph::PassContext& context, const Maps& maps) {
    auto defines = maps.storage->defines(context);
    defines.merge(node_defines(maps.layout));
    return defines;
}

FrameConstants frame_constants(const Maps& maps, std::int64_t first, std::int64_t count) {
    static_assert(sizeof(MapFrame) == 6 * sizeof(glm::vec4));
    return {{&maps.frames[static_cast<std::size_t>(first)].u, static_cast<std::size_t>(6 * count)}};
}

}  // namespace ir::passes::ldm
