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

namespace {

const std::string layer_order = " A layer per sample and level: sample × levels + level.";
const std::string sub_images = " Pixels stand in the sub-images of their level.";
const std::string where_seen = " Pixels stand where they are seen.";

std::vector<OutputDescription> of_samples() {
    return {
        {.key = "splats.hit_level",
         .label = "Level of the hit",
         .kind = OutputKind::stack,
         .doc = "The level of the hierarchical framebuffer whose hit decided: the finest that has one, or "
                "with estimated influence that of the nearest hit. It is the one that counts. A layer per "
                "sample.",
         .categories = {{"",
                         {{-1, "no hit", tints::dark},
                          {0, "finest level", tints::yellow},
                          {1, "level 1", tints::orange},
                          {2, "level 2", tints::vermilion},
                          {3, "level 3", tints::purple},
                          {4, "level 4", tints::blue},
                          {5, "level 5", tints::sky},
                          {6, "level 6", tints::green}}}}},
        {.key = "splats.nearest",
         .label = "Surfels that were hit",
         .kind = OutputKind::stack,
         .semantic = Semantic::id,
         .doc =
             "1 + index of the surfel that the sample's ray met, or 2147483648 + that of the triangle, where "
             "level 0 is of triangles; 0: nothing was met. A layer per sample."},
        {.key = "splats.epsilon",
         .label = "Implied ε",
         .kind = OutputKind::stack,
         .colour_map = "viridis",
         .doc = "How coarse what was hit is: (r 2^k / t)², with the surfel's radius r, the shell k that its "
                "disc was enlarged for, and the distance t. Large values tell where enlarged discs do not "
                "follow the surface or reach through others. 0: no hit. A layer per sample."},
    };
}

const std::string nearest_z =
    "t²/r² of the nearest surfel along the pixel's ray, r the reach of all levels; 1: none.";
const std::string winners_radiance =
    "What the winners store for the side that was hit: without their highlights, 0 for ambient occlusion. "
    "Alpha 0: none.";

std::vector<OutputDescription> of_levels() {
    return {
        {.key = "splats.depth",
         .label = "Bounced z in sub-images",
         .kind = OutputKind::stack,
         .semantic = Semantic::depth,
         .doc = nearest_z + sub_images + layer_order},
        {.key = "splats.winner",
         .label = "Winners in sub-images",
         .kind = OutputKind::stack,
         .semantic = Semantic::id,
         .doc = "1 + index of the surfel with the smallest z; 0: none." + sub_images + layer_order},
        {.key = "splats.radiance",
         .label = "Radiance in sub-images",
         .kind = OutputKind::stack,
         .semantic = Semantic::radiance,
         .unit = "W/(m² sr)",
         .doc = winners_radiance + sub_images + layer_order},
        {.key = "splats.level_depth",
         .label = "Bounced z by level",
         .kind = OutputKind::stack,
         .semantic = Semantic::depth,
         .doc = nearest_z + where_seen + layer_order},
        {.key = "splats.level_radiance",
         .label = "Radiance by level",
         .kind = OutputKind::stack,
         .semantic = Semantic::radiance,
         .unit = "W/(m² sr)",
         .doc = winners_radiance + where_seen + layer_order},
    };
}

}  // namespace

std::vector<OutputDescription> visible_outputs() {
    auto outputs = of_samples();
    for (auto& output : of_levels()) outputs.push_back(std::move(output));
    for (auto& output : outputs) output.active_when = {"visibility", {true}};
    return outputs;
}

}  // namespace ir::methods::deep_screen_space
