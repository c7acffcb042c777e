#include "renderers/passes/ldm/map_views.h"

#include <array>
#include <numbers>

#include "renderers/graph/pass_context.h"

namespace ir::passes::ldm {
namespace {

using graph::FieldType;

/// Constants of layers.comp.
struct Layers {
    unsigned map;
    bool first;
    int resolution;
    IR_FIELDS(map, first, resolution)
};

bool is_turned(const Maps& maps) {
    return maps.options.rotation != glm::dmat3(1);
}

/// Elements of "ldm.directions" as words.
std::vector<std::uint32_t> regions(const Maps& maps) {
    using std::numbers::pi;
    std::vector<std::uint32_t> words;
    const auto add = [&](double value) {
        words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
    };
    for (std::size_t map = 0; map < maps.directions.size(); ++map) {
        const auto& d = maps.directions[map];
        for (const int side : {1, -1}) {
            for (int axis = 0; axis < 3; ++axis) add(side * double(maps.frames[map].direction[axis]));
            if (!is_turned(maps)) {
                const bool above = side > 0;
                add(above ? d.colatitude_min : pi - d.colatitude_max);
                add(above ? d.colatitude_max : pi - d.colatitude_min);
                add(d.longitude_min + (above ? 0 : pi));
                add(d.longitude_max + (above ? 0 : pi));
            }
            words.push_back(static_cast<std::uint32_t>(map));
            words.push_back(static_cast<std::uint32_t>(side));
        }
    }
    return words;
}

}  // namespace

SelectorDescription map_selector_description() {
    return {.key = map_selector,
            .label = "Map",
            .doc = "The layered depth map that is shown, and queried for the pixel.",
            .parameter = "directions"};
}

std::vector<OutputDescription> map_outputs() {
    return {
        {.key = "ldm.layers",
         .label = "Layers of a map",
         .semantic = Semantic::count,
         .doc = "Depths at each texel of the map chosen; of all maps the maximum.",
         .explains = true},
        {.key = "ldm.points",
         .label = "Points of maps",
         .kind = OutputKind::point_set,
         .semantic = Semantic::position,
         .unit = "m",
         .doc = "All depths of the maps chosen, as points of the scene. normal: of the triangle, on the side "
                "that sees its corners counter-clockwise. facing: 1 where that side looks to where the map "
                "looks from, else -1. depth: metres along the map's direction, from the scene's near end. "
                "layer: 0 is the first along that direction.",
         .explains = true},
        {.key = "ldm.xray",
         .label = "X-ray of a map",
         .kind = OutputKind::glyphs,
         .unit = "m",
         .doc =
             "The points of the maps chosen as pieces of surface: of each the texel's outline, tilted as the "
             "triangle lies, but not steeper than 4 texels of depth a texel. Seen through each other, they are "
             "the map; the layers' slider cuts it open.",
         .explains = true},
        {.key = "ldm.directions",
         .label = "Directions",
         .kind = OutputKind::sphere_values,
         .doc = "The partition of the sphere into 2N regions: each map's direction (side 1) and its opposite "
                "(side -1), as this frame uses them, and bounds of the regions in radians. A set that is "
                "turned at random has no bounds."},
    };
}

MapRange chosen_maps(const Inspection& inspection, const Maps& maps) {
    const int item = inspection.item(map_selector);
    if (item == Inspection::all) return {0, maps.layout.maps};
    return {std::clamp(item, 0, maps.layout.maps - 1), 1};
}

std::vector<graph::Field> region_fields(const Maps& maps) {
    std::vector<graph::Field> fields{{"centre", FieldType::f32, 3}};
    if (!is_turned(maps)) {
        fields.push_back({"colatitude", FieldType::f32, 2});
        fields.push_back({"longitude", FieldType::f32, 2});
    }
    fields.push_back({"map", FieldType::u32});
    fields.push_back({"side", FieldType::i32});
    return fields;
}

graph::BufferRef show_directions(graph::GraphBuilder& builder, MapsPointer maps) {
    const auto buffer = builder.output(
        "ldm.directions", {.fields = region_fields(*maps), .elements = 2 * maps->directions.size()});
    builder.pass("directions").writes(buffer).execute([buffer, maps](graph::PassContext& context) {
        context.upload(buffer, std::as_bytes(std::span<const std::uint32_t>(regions(*maps))));
    });
    return buffer;
}

graph::ImageRef declare_layers(graph::GraphBuilder& builder, const Maps& maps) {
    return builder.output("ldm.layers",
                          {.format = gl::Format::r32ui,
                           .extent = graph::Extent::fixed(maps.layout.resolution, maps.layout.resolution)});
}

void show_layers(graph::GraphBuilder& builder, MapsPointer maps, int batch, MapRange shown,
                 graph::ImageRef layers) {
    const auto range = shown.in_batch(*maps, batch);
    if (range.count == 0) return;
    auto pass = builder.pass("layers" + maps->batch_name(batch));
    reads_maps(pass, *maps);
    pass.writes("layers", layers).execute([=](graph::PassContext& context) {
        gl::ProgramSource source{{"passes/ldm/layers.comp"}};
        source.defines = defines_of(context, *maps);
        const auto& program = context.use(source);
        const int resolution = maps->layout.resolution;
        for (int map = range.first; map < range.first + range.count; ++map) {
            program.set(
                Layers{static_cast<unsigned>(map - maps->first_map(batch)), map == shown.first, resolution});
            program.dispatch(resolution, resolution);
            context.barrier();
        }
    });
}

}  // namespace ir::passes::ldm
