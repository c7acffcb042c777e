#include "renderers/passes/ldm/points.h"

#include <cstddef>
#include <numeric>

#include "renderers/core/record.h"
#include "renderers/passes/ldm/rasterisers.h"
#include "shaders/passes/ldm/point.glsl.h"

namespace ir::passes::ldm {
namespace {

using graph::FieldType;

constexpr std::uint64_t max_points = 4'000'000;

/// An element of "ldm.points", as words in shaders/passes/ldm/point.glsl.
struct Point {
    glm::vec3 position, normal;
    float facing, depth;
    std::uint32_t layer, map;
    IR_FIELDS(position, normal, facing, depth, layer, map)
};

static_assert(sizeof(Point) == 4 * point_words && offsetof(Point, normal) == 4 * point_normal &&
              offsetof(Point, facing) == 4 * point_facing && offsetof(Point, depth) == 4 * point_depth &&
              offsetof(Point, layer) == 4 * point_layer && offsetof(Point, map) == 4 * point_map);

/// Constants of points.comp.
struct WritePoints {
    unsigned first_frame, first_map, map_count, stride;
    int resolution;
    IR_FIELDS(first_frame, first_map, map_count, stride, resolution)
};

/// Constants of point_places.comp and point_ties.comp.
struct PointTexels {
    unsigned texel_count;
    IR_FIELDS(texel_count)
};

std::uint64_t texels_in(const Maps& maps, MapRange range) {
    return static_cast<std::uint64_t>(range.count) * maps.layout.map_texels();
}

std::uint64_t shown_texels(const Maps& maps, MapRange range, std::uint64_t stride) {
    return (texels_in(maps, range) + stride - 1) / stride;
}

std::uint64_t choose_stride(const Maps& maps, MapRange shown, std::uint64_t max_buffer_bytes) {
    const auto most = std::min(max_points, max_buffer_bytes / (2 * sizeof(Point)));
    const auto expected = texels_in(maps, shown) * expected_layers;
    auto stride = std::max<std::uint64_t>(1, (expected + most - 1) / most);
    // Else whole columns would be left out.
    while (stride > 1 && std::gcd(stride, static_cast<std::uint64_t>(maps.layout.resolution)) != 1) ++stride;
    return stride;
}

std::string stride_note(std::uint64_t stride) {
    return "of the maps shown, one texel in " + std::to_string(stride) +
           " has points, so that at most about " + std::to_string(max_points / 1'000'000) + " million result";
}

void write_points(const graph::PassContext& context, const Maps& maps, int batch, MapRange range,
                  const Points& points) {
    if (range.first == points.maps.first)
        context.add(points.stride_shown, static_cast<std::uint32_t>(points.stride));
    const auto texels = shown_texels(maps, range, points.stride);
    const auto over_texels = [&](bool count) {
        gl::ProgramSource source{{"passes/ldm/points.comp"}};
        source.defines = defines_of(context, maps);
        if (count) source.defines["COUNT"] = "1";
        const auto& program = context.use(source);
        program.set(WritePoints{.first_frame = static_cast<unsigned>(range.first),
                                .first_map = static_cast<unsigned>(range.first - maps.first_map(batch)),
                                .map_count = static_cast<unsigned>(range.count),
                                .stride = static_cast<unsigned>(points.stride),
                                .resolution = maps.layout.resolution});
        program.dispatch(static_cast<std::int64_t>(texels));
        context.barrier();
    };
    over_texels(true);
    const auto& places = context.use({{"passes/ldm/point_places.comp"}});
    places.set(PointTexels{static_cast<unsigned>(texels)});
    places.dispatch(1);
    context.barrier();
    over_texels(false);
}

/// Rasterises the maps shown of a batch again. Items: each is one triangle in all maps of one chunk.
class FaceSearch {
  public:
    FaceSearch(const SceneBuffers& scene, const Maps& maps, MapRange range, const Points& points)
        : scene_(scene), maps_(maps), range_(range), points_(points) {
        maps_.list = {points.state, {}, {}};
        maps_.face_points = points.points;
        maps_.face_texels = points.texels;
        if (maps_.options.builder == BuilderKind::compute) maps_.large = points.strips;
    }

    std::int64_t chunks() const {
        return (range_.count + maps_.layout.chunk_maps - 1) / maps_.layout.chunk_maps;
    }

    void run(const graph::PassContext& context, const graph::Slice& slice) const {
        const auto triangles = static_cast<std::int64_t>(context.inputs().world->triangles());
        for (std::int64_t begin = slice.begin; begin < slice.end;) {
            const auto index = begin / triangles, end = std::min(slice.end, (index + 1) * triangles);
            if (begin == index * triangles) context.clear(points_.state);
            const auto chunk = chunk_at(index);
            rasterise(context, chunk, begin - index * triangles, end - index * triangles);
            if (end == (index + 1) * triangles && maps_.options.builder == BuilderKind::compute)
                rasterise_large(context, chunk);
            begin = end;
        }
        if (slice.last) settle_ties(context);
    }

  private:
    /// Maps count from the first one shown.
    Chunk chunk_at(std::int64_t index) const {
        const auto first = static_cast<int>(index) * maps_.layout.chunk_maps;
        return {first, std::min(maps_.layout.chunk_maps, range_.count - first)};
    }

    FaceTarget target(const Chunk& chunk) const {
        return {static_cast<std::uint32_t>(texels_in(maps_, {0, chunk.first_map})),
                static_cast<std::uint32_t>(points_.stride)};
    }

    void rasterise(const graph::PassContext& context, const Chunk& chunk, std::int64_t first,
                   std::int64_t end) const {
        const int first_map = range_.first + chunk.first_map;
        if (maps_.options.builder == BuilderKind::raster)
            draw_triangles(context, scene_, maps_, chunk, first_map, first, end, target(chunk));
        else
            dispatch_triangles(context, maps_, chunk, first_map, first, end, target(chunk));
        context.barrier();
    }

    void rasterise_large(const graph::PassContext& context, const Chunk& chunk) const {
        dispatch_large_triangles(context, maps_, chunk, range_.first + chunk.first_map, target(chunk));
        context.barrier();
    }

    void settle_ties(const graph::PassContext& context) const {
        const auto texels = shown_texels(maps_, range_, points_.stride);
        const auto& ties = context.use({{"passes/ldm/point_ties.comp"}});
        ties.set(PointTexels{static_cast<unsigned>(texels)});
        ties.dispatch(static_cast<std::int64_t>(texels));
        context.barrier();
    }

    SceneBuffers scene_;
    Maps maps_;
    MapRange range_;
    Points points_;
};

void declare_scratch(graph::GraphBuilder& builder, const Maps& maps, Points& points) {
    const MapRange largest{0, std::min(points.maps.count, maps.layout.batch_maps)};
    points.texels =
        builder.buffer({.text = {.key = "ldm.point_texels",
                                 .label = "First points of texels",
                                 .doc = "Number of the first point of each texel that is shown, and where "
                                        "the last one's end, of the batch of maps that came last."},
                        .name = "LdmPointTexels",
                        .fields = {{"first", FieldType::u32}},
                        .elements = shown_texels(maps, largest, points.stride) + 1});
    const auto chunk_texels = texels_in(maps, {0, std::min(points.maps.count, maps.layout.chunk_maps)});
    points.state = builder.buffer({.text = {.key = "ldm.point_state",
                                            .label = "State of finding faces",
                                            .doc = "What the steps of rasterising again tell each other."},
                                   .name = "LdmState",
                                   .fields = {{"word", FieldType::u32}},
                                   .elements = state_words});
    if (maps.options.builder != BuilderKind::compute) return;
    points.strips =
        builder.buffer({.text = {.key = "ldm.point_strips",
                                 .label = "Strips of large triangles for faces",
                                 .doc = "Triangle, and map | strip << 8, of the chunk of maps that was "
                                        "rasterised last."},
                        .name = "LdmLarge",
                        .fields = {{"triangle", FieldType::u32}, {"map_strip", FieldType::u32}},
                        .elements = std::max<std::uint64_t>(1 << 14, chunk_texels / 2),
                        .growable = true});
    points.strips_requested = builder.counter({.key = "ldm.point_strips_requested",
                                               .name = "LargeRequested",
                                               .label = "Strips of the largest chunk for faces",
                                               .growth_of = points.strips});
}

}  // namespace

MapRange MapRange::in_batch(const Maps& maps, int batch) const {
    const int begin = std::max(first, maps.first_map(batch));
    const int end = std::min(first + count, maps.first_map(batch) + maps.batch_maps(batch));
    return {begin, std::max(0, end - begin)};
}

Points declare_points(graph::GraphBuilder& builder, const Maps& maps, MapRange shown) {
    Points points;
    points.maps = shown;
    points.stride = choose_stride(maps, shown, builder.max_buffer_bytes());
    points.reserved = shown_texels(maps, shown, points.stride) * expected_layers;
    points.points = builder.output("ldm.points", {.name = "LdmPoints",
                                                  .fields = record_fields<Point>(),
                                                  .elements = points.reserved,
                                                  .growable = true});
    points.count = builder.counter({.key = "ldm.shown_points",
                                    .name = "PointCount",
                                    .label = "Points shown",
                                    .growth_of = points.points});
    points.stride_shown = builder.counter({.key = "ldm.point_stride",
                                           .label = "Texels to one with points",
                                           .doc = "Of the maps shown, one texel in so many has points."});
    declare_scratch(builder, maps, points);
    return points;
}

void find_points(graph::GraphBuilder& builder, const SceneBuffers& scene, std::shared_ptr<const Maps> maps,
                 int batch, const Points& points) {
    const auto range = points.maps.in_batch(*maps, batch);
    if (range.count == 0) return;
    auto places = builder.pass("points" + maps->batch_name(batch));
    reads_maps(places, *maps);
    places.writes(points.texels, points.points).counts(points.count).counts(points.stride_shown);
    // Only a pass that runs knows that points are wanted; the builder outlives its passes.
    places.execute([=, &builder](graph::PassContext& context) {
        if (points.stride > 1) builder.note(stride_note(points.stride));
        write_points(context, *maps, batch, range, points);
    });

    auto faces = builder.pass("point faces" + maps->batch_name(batch));
    faces.reads(maps->frame_buffer, points.texels, scene.positions, scene.indices, scene.triangle_materials,
                scene.uv0, scene.uv1, scene.materials, scene.opacity, scene.opacity_words);
    faces.writes(points.points, points.state);
    if (points.strips.index >= 0) faces.writes(points.strips).counts(points.strips_requested);
    const auto search = std::make_shared<FaceSearch>(scene, *maps, range, points);
    faces.execute_sliced(
        search->chunks() * static_cast<std::int64_t>(builder.inputs().world->triangles()),
        [search](graph::PassContext& context, graph::Slice slice) { search->run(context, slice); });
}

}  // namespace ir::passes::ldm
