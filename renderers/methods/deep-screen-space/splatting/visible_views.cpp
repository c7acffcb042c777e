#include "renderers/methods/deep-screen-space/splatting/visible.h"
#include "renderers/passes/bounce/tiles.h"

namespace ir::methods::deep_screen_space {
namespace {

struct LayersView {
    std::string pass, key;
    gl::ProgramSource source;
    gl::Format format;
    bool unshuffled;
    const char* result;
    std::vector<std::pair<const char*, graph::ImageRef>> textures;
    bool reads_surfels;
};

/// Constants of visible_depth.comp and visible_radiance.comp.
struct VisibleLevels {
    int levels;
    IR_FIELDS(levels)
};

/// An image with a layer per sample and level, an invocation each texel.
void show_layers(graph::GraphBuilder& builder, const VisibleSplats& visible, const LayersView& view) {
    const auto& splats = visible.splats;
    graph::ImageDesc desc;
    desc.format = view.format;
    desc.layers = splats.samples * splats.hierarchy.levels;
    if (!view.unshuffled) desc.extent = graph::Extent::fixed(splats.hierarchy.width, splats.hierarchy.height);
    const auto image = builder.output(view.key, std::move(desc));
    auto pass = builder.pass(view.pass);
    for (const auto& [name, texture] : view.textures) pass.reads(name, texture);
    if (view.reads_surfels) pass.reads("Surfels", splats.surfels.records);
    if (view.reads_surfels && splats.surfels.are_lit()) pass.reads("SurfelLights", splats.surfels.lights);
    pass.writes(view.result, image).compute(view.source, image, VisibleLevels{splats.hierarchy.levels});
}

void show_epsilon(graph::GraphBuilder& builder, const VisibleSplats& visible) {
    const auto image =
        builder.output("splats.epsilon", {.format = gl::Format::r32f, .layers = visible.splats.samples});
    auto pass = builder.pass("implied epsilon");
    pass.reads("nearest", visible.nearest)
        .reads("levels", visible.hit_level)
        .reads("distances", visible.samples.distance)
        .reads(visible.gbuffer.position)
        .reads("Surfels", visible.splats.surfels.records)
        .writes("epsilon_image", image);
    passes::bounce::compute_by_tiles(pass, builder,
                                     with_acceptance({{folder + "visible_epsilon.comp"}}, visible.splats),
                                     visible_level(visible.splats));
}

}  // namespace

void show_levels(graph::GraphBuilder& builder, const VisibleSplats& visible) {
    const auto& hierarchy = visible.splats.hierarchy;
    const auto directions = visible.directions.directions;
    gl::ProgramSource radiance{{folder + "visible_radiance.comp"}};
    radiance.defines["LIT"] = visible.splats.surfels.are_lit() ? "1" : "0";
    auto unshuffled = radiance;
    unshuffled.defines["UNSHUFFLED"] = "1";
    show_layers(builder, visible,
                {"unshuffle z",
                 "splats.level_depth",
                 {{folder + "visible_depth.comp"}},
                 gl::Format::r32f,
                 true,
                 "depth_image",
                 {{"places", hierarchy.places}, {"depths", visible.depth}},
                 false});
    show_layers(
        builder, visible,
        {"radiance in sub-images",
         "splats.radiance",
         radiance,
         gl::Format::rgba32f,
         false,
         "radiance_image",
         {{"layout_texture", hierarchy.layout}, {"winners", visible.winner}, {"directions", directions}},
         true});
    show_layers(builder, visible,
                {"radiance by level",
                 "splats.level_radiance",
                 unshuffled,
                 gl::Format::rgba32f,
                 true,
                 "radiance_image",
                 {{"places", hierarchy.places}, {"winners", visible.winner}, {"directions", directions}},
                 true});
    show_epsilon(builder, visible);
}

}  // namespace ir::methods::deep_screen_space
