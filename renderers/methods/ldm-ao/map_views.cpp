#include "renderers/methods/ldm-ao/map_views.h"

#include <array>
#include <numbers>

#include "renderers/graph/pass_context.h"

namespace ir::methods::ldm_ao {
namespace {

namespace ldm = passes::ldm;
using graph::FieldType;

bool is_turned(const ldm::Maps& maps) {
    return maps.options.rotation != glm::dmat3(1);
}

/// Elements of "ldm.directions" as words.
std::vector<std::uint32_t> regions(const ldm::Maps& maps) {
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

ldm::MapRange chosen_maps(const Inspection& inspection, const ldm::Maps& maps) {
    const int item = inspection.item(map_selector);
    if (item == Inspection::all) return {0, maps.layout.maps};
    return {std::clamp(item, 0, maps.layout.maps - 1), 1};
}

std::vector<graph::Field> region_fields(const ldm::Maps& maps) {
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
    graph::BufferDesc desc;
    desc.text.key = "ldm.directions";
    desc.text.label = "Directions";
    desc.text.doc =
        "Two elements per map: its direction v (side 1) and -v (side -1), as this frame uses them. Bounds of "
        "the "
        "regions in radians: colatitude from +Y, longitude from +X towards +Z; missing where the set is "
        "turned "
        "at random.";
    desc.kind = OutputKind::sphere_values;
    desc.fields = region_fields(*maps);
    desc.elements = 2 * maps->directions.size();
    const auto buffer = builder.buffer(desc);
    builder.pass("directions").writes(buffer).execute([buffer, maps](graph::PassContext& context) {
        context.upload(buffer, std::as_bytes(std::span<const std::uint32_t>(regions(*maps))));
    });
    return buffer;
}

graph::ImageRef declare_layers(graph::GraphBuilder& builder, const ldm::Maps& maps) {
    return builder.image({.text = {.key = "ldm.layers",
                                   .label = "Layers of a map",
                                   .doc = "Depths at each texel of the map chosen; of all maps the most.",
                                   .semantic = Semantic::count},
                          .format = gl::Format::r32ui,
                          .extent = graph::Extent::fixed(maps.layout.resolution, maps.layout.resolution)});
}

void show_layers(graph::GraphBuilder& builder, MapsPointer maps, int batch, ldm::MapRange shown,
                 graph::ImageRef layers) {
    const auto range = shown.in_batch(*maps, batch);
    if (range.count == 0) return;
    auto pass = builder.pass("layers" + maps->batch_name(batch));
    ldm::reads_maps(pass, *maps);
    pass.writes(layers).execute([=](graph::PassContext& context) {
        gl::ProgramSource source{{"methods/ldm-ao/layers.comp"}};
        source.defines = ldm::bind_maps(context, *maps, 0, 1);
        context.bind_storage_image(0, layers);
        const auto& program = context.program(source);
        program.use();
        program.set("resolution", maps->layout.resolution);
        for (int map = range.first; map < range.first + range.count; ++map) {
            program.set("map", static_cast<unsigned>(map - maps->first_map(batch)));
            program.set("first", static_cast<int>(map == shown.first));
            program.dispatch(maps->layout.resolution, maps->layout.resolution);
            context.barrier();
        }
    });
}

}  // namespace ir::methods::ldm_ao
