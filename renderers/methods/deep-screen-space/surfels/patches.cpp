#include "renderers/methods/deep-screen-space/surfels/steps.h"

#include <algorithm>

#include "renderers/gl/dispatch_items.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/deep-screen-space/surfels/view.h"
#include "renderers/passes/scan/scan.h"
#include "shaders/methods/deep-screen-space/surfels/patch.glsl.h"

namespace ir::methods::deep_screen_space {
namespace {

using graph::FieldType;
using graph::GraphBuilder;
using graph::PassContext;
using graph::Slice;

constexpr std::int64_t first_slice = 4096;

struct Splitting {
    passes::SceneBuffers scene;
    Growing parts;    ///< that the first round leaves
    Growing words;    ///< patches of each part, then their places
    Growing patches;  ///< of the second round
    Growing points;   ///< of each patch, then their places
    graph::CounterRef triangles, coarse;
    float reach;
    Parameters parameters;
    std::string fingerprint;
    graph::BufferRef order = {};  ///< of triangles; only systematic

    bool systematic() const { return parameters.placement == Placement::systematic; }
};

/// Of lists that split.comp reads and writes.
struct Room {
    unsigned capacity = 0, part_capacity = 0, point_capacity = 0, item_end = 0;
    IR_FIELDS(capacity, part_capacity, point_capacity, item_end)
};

/// Constants of split.comp.
struct Split {
    Ideal ideal;
    Frustum frustum;
    float fine_part;
    unsigned seed;
    Room room;
    IR_FIELDS(ideal, frustum, fine_part, seed, room)
};

const gl::Program& use(const PassContext& context, const Splitting& s, int round, bool packs,
                       const Room& room) {
    const auto& program = context.use({{"methods/deep-screen-space/surfels/split.comp"},
                                       {{"ROUND", std::to_string(round)},
                                        {"PACKS", packs ? "1" : "0"},
                                        {"SYSTEMATIC", s.systematic() ? "1" : "0"}}});
    const auto& view = context.inputs().view;
    // the published pattern of 2014 has no smaller surfels to choose from
    const float fine_part = s.parameters.placement == Placement::random ? s.parameters.fine_area : 1.0f;
    program.set(Split{ideal(view, s.parameters), frustum(view, s.reach, s.parameters), fine_part,
                      random_seed(context.inputs(), s.parameters), room});
    return program;
}

void first_round(GraphBuilder& builder, const Splitting& s) {
    const auto triangles = static_cast<std::int64_t>(builder.inputs().world->triangles());
    const auto counts =
        builder.buffer({.text = {.key = "surfels.parts.counts",
                                 .label = "Parts of triangles",
                                 .doc = "How many parts of each triangle are left."},
                        .fields = {{"count", FieldType::u32}},
                        .elements = static_cast<std::uint64_t>(std::max<std::int64_t>(1, triangles)),
                        .cleared = true,
                        .fingerprint = s.fingerprint});
    auto cull = builder.pass("cull triangles");
    if (s.systematic()) cull.reads(s.order);
    cull.reads(s.scene.positions, s.scene.indices)
        .writes("Counts", counts)
        .execute_sliced(
            triangles,
            [=](PassContext& context, Slice slice) {
                const auto& program = use(context, s, 1, false, {});
                gl::dispatch_items(program, slice.begin, slice.end);
            },
            first_slice);
    const auto places = passes::exclusive_scan(
        builder, "surfels.parts", counts, static_cast<std::uint64_t>(std::max<std::int64_t>(1, triangles)),
        s.parts.count);
    auto split = builder.pass("split triangles");
    if (s.systematic()) split.reads(s.order);
    split.reads(s.scene.positions, s.scene.indices)
        .reads("Places", places)
        .writes("Patches", s.parts.buffer)
        .counts("TriangleCount", s.triangles)
        .execute_sliced(
            triangles,
            [=](PassContext& context, Slice slice) {
                const auto room = static_cast<unsigned>(context.capacity(s.parts.buffer));
                const auto& program = use(context, s, 1, true, {.capacity = room});
                gl::dispatch_items(program, slice.begin, slice.end);
            },
            first_slice);
}

void second_round(GraphBuilder& builder, const Splitting& s) {
    builder.pass("cull parts of triangles")
        .reads(s.scene.positions, s.scene.indices)
        .reads("Parts", s.parts.buffer)
        .writes("Counts", s.words.buffer)
        .counts("PartCount", s.parts.count)
        .counts("WordCount", s.words.count)
        .execute_sliced(
            packing_parts,
            [=](PassContext& context, Slice slice) {
                const auto items = context.capacity(s.words.buffer);
                const auto& program =
                    use(context, s, 2, false,
                        {.part_capacity = static_cast<unsigned>(context.capacity(s.parts.buffer)),
                         .item_end = static_cast<unsigned>(items)});
                dispatch_parts(program, items, slice);
            },
            1);
    passes::scan_in_place(builder, "surfels.patches", s.words.buffer, s.patches.count);
    auto pass = builder.pass("split parts of triangles");
    if (!s.systematic()) pass.counts("CoarseCount", s.coarse);
    pass.reads(s.scene.positions, s.scene.indices)
        .reads("Parts", s.parts.buffer)
        .reads("Places", s.words.buffer)
        .writes("Patches", s.patches.buffer)
        .writes("Points", s.points.buffer)
        .counts("PartCount", s.parts.count)
        .execute_sliced(
            packing_parts,
            [=](PassContext& context, Slice slice) {
                const auto items =
                    std::min(context.capacity(s.parts.buffer), context.capacity(s.words.buffer));
                const auto& program =
                    use(context, s, 2, true,
                        {.capacity = static_cast<unsigned>(context.capacity(s.patches.buffer)),
                         .part_capacity = static_cast<unsigned>(items),
                         .point_capacity = static_cast<unsigned>(context.capacity(s.points.buffer)),
                         .item_end = static_cast<unsigned>(items)});
                dispatch_parts(program, items, slice);
            },
            1);
}

}  // namespace

graph::CounterRef declare_units(GraphBuilder& builder) {
    return builder.counter({.key = "surfels.units", .label = "Worth of patches"});
}

graph::CounterRef declare_triangles_left(GraphBuilder& builder) {
    return builder.counter({.key = "surfels.triangles",
                            .label = "Triangles left",
                            .doc = "That are not culled, nor without area."});
}

graph::CounterDesc patches_counter() {
    return {.key = "surfels.patches",
            .label = "Patches",
            .doc = "Triangles, or parts of them, that are divided into surfels."};
}

Patches cut_patches(GraphBuilder& builder, const passes::SceneBuffers& scene, graph::CounterRef total,
                    float reach, std::uint64_t reserve, const Parameters& parameters,
                    const std::string& fingerprint) {
    Splitting s;
    s.scene = scene;
    s.fingerprint = fingerprint;
    s.parameters = parameters;
    s.parts =
        growing(builder,
                {.text = {.key = "surfels.parts.list",
                          .label = "Parts of triangles, after the first round",
                          .doc = "Triangles that are left, or similar parts of those that are too large."},
                 .fields = record_fields<Patch>(),
                 .fingerprint = fingerprint},
                {.key = "surfels.parts", .label = "Parts of triangles, after the first round"}, reserve);
    s.words =
        growing(builder,
                {.text = {.key = "surfels.patches.places",
                          .label = "Places of patches",
                          .doc = "For each part of the first round how many patches are before its own."},
                 .fields = {{"place", FieldType::u32}},
                 .fingerprint = fingerprint},
                {.key = "surfels.patches.words", .label = "Parts of triangles with places"}, reserve);
    s.patches = growing(builder,
                        {.text = {.key = "surfels.patches.list",
                                  .label = "Patches",
                                  .doc = "What the tessellator divides. splits: parts along each side of the "
                                         "triangle; place: column and row of the part, 12 bits each, and "
                                         "whether it is turned; level: of tessellation."},
                         .fields = record_fields<Patch>(),
                         .fingerprint = fingerprint},
                        patches_counter(), reserve);
    s.points = growing(builder,
                       {.text = {.key = "surfels.points",
                                 .label = "Points of patches",
                                 .doc = "How many fine surfels are before those of each patch."},
                        .fields = {{"place", FieldType::u32}},
                        .cleared = true,
                        .fingerprint = fingerprint},
                       {.key = "surfels.patches.points", .label = "Patches with places of points"}, reserve);
    s.triangles = declare_triangles_left(builder);
    if (!s.systematic())
        s.coarse =
            builder.counter({.key = "surfels.coarse",
                             .label = "Patches divided too little",
                             .doc = "Whose surfels are larger than fine_area asks for: the triangle is too "
                                    "large to be split far enough."});
    s.reach = reach;
    if (s.systematic()) s.order = order_triangles(builder);
    first_round(builder, s);
    second_round(builder, s);
    passes::scan_in_place(builder, "surfels.fine", s.points.buffer, total);
    return {s.patches, s.points, total, s.triangles, {}};
}

namespace {

/// Constants of place.comp.
struct Place {
    Ideal ideal;
    unsigned seed, patch_capacity, capacity;
    IR_FIELDS(ideal, seed, patch_capacity, capacity)
};

}  // namespace

Surfels place(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const Patches& patches,
              std::uint64_t reserve, const Parameters& parameters, const std::string& fingerprint) {
    const auto kept = declare_records(builder, reserve, fingerprint);
    builder.pass("place surfels")
        .reads(scene.positions, scene.indices, scene.uv0, scene.uv1, scene.triangle_materials,
               scene.materials, scene.opacity, scene.opacity_words)
        .reads("Patches", patches.list.buffer)
        .reads("Points", patches.points.buffer)
        .writes("Surfels", kept.buffer)
        .counts("PatchCount", patches.list.count)
        .counts("WordCount", patches.points.count)
        .counts("UnitCount", patches.total)
        .counts("SurfelCount", kept.count)
        .execute_sliced(
            packing_parts,
            [=](graph::PassContext& context, graph::Slice slice) {
                const auto& program = context.use({{"methods/deep-screen-space/surfels/place.comp"}});
                const auto capacity = context.capacity(kept.buffer);
                const auto listed =
                    std::min(context.capacity(patches.list.buffer), context.capacity(patches.points.buffer));
                program.set(Place{ideal(context.inputs().view, parameters),
                                  random_seed(context.inputs(), parameters), static_cast<unsigned>(listed),
                                  static_cast<unsigned>(capacity)});
                dispatch_parts(program, capacity, slice);
            },
            1);
    return count_stored(builder, kept, fingerprint);
}

}  // namespace ir::methods::deep_screen_space
