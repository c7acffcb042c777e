#include "renderers/methods/deep-screen-space/splatting/folder.h"
#include "renderers/methods/deep-screen-space/splatting/visible.h"
#include "renderers/passes/bounce/tiles.h"

namespace ir::methods::deep_screen_space {
namespace {

struct LayersView {
    std::string pass, key;
    gl::ProgramSource source;
    gl::Format format;
    bool unshuffled;
    std::vector<graph::ImageRef> textures;  ///< for units 0, 1, …
};

/// An image with a layer per sample and level, an invocation each texel.
void show_layers(graph::GraphBuilder& builder, const VisibleSplats& visible, const LayersView& view) {
    const auto& splats = visible.splats;
    graph::ImageDesc desc;
    desc.text = visible_text(view.key);
    desc.format = view.format;
    desc.layers = splats.samples * splats.hierarchy.levels;
    if (!view.unshuffled) desc.extent = graph::Extent::fixed(splats.hierarchy.width, splats.hierarchy.height);
    const auto image = builder.image(std::move(desc));
    auto pass = builder.pass(view.pass);
    for (const auto texture : view.textures) pass.reads(texture);
    pass.reads(splats.surfels).writes(image).execute([=](graph::PassContext& p) {
        const auto& program = p.program(view.source);
        program.use();
        p.bind_buffer(0, splats.surfels);
        int unit = 0;
        for (const auto texture : view.textures) p.bind_texture(unit++, texture);
        p.bind_storage_image(0, image);
        program.set("levels", splats.hierarchy.levels);
        const auto shape = p.shape(image);
        program.dispatch(shape.width, shape.height, shape.layers);
    });
}

void show_epsilon(graph::GraphBuilder& builder, const VisibleSplats& visible, graph::ImageRef distance) {
    graph::ImageDesc desc;
    desc.text = visible_text("splats.epsilon");
    desc.format = gl::Format::r32f;
    desc.layers = visible.splats.samples;
    const auto image = builder.image(std::move(desc));
    const std::vector<graph::ImageRef> textures{visible.nearest, visible.hit_level, distance,
                                                visible.gbuffer.position};
    auto pass = builder.pass("implied epsilon");
    for (const auto texture : textures) pass.reads(texture);
    pass.reads(visible.splats.surfels).writes(image);
    passes::bounce::execute_by_tiles(pass, builder, [=](graph::PassContext& p) -> const gl::Program& {
        const auto& program = p.program({{folder + "visible_epsilon.comp"}});
        program.use();
        p.bind_buffer(0, visible.splats.surfels);
        int unit = 0;
        for (const auto texture : textures) p.bind_texture(unit++, texture);
        p.bind_storage_image(0, image);
        set_splat_level(program, visible.splats);
        return program;
    });
}

}  // namespace

void show_levels(graph::GraphBuilder& builder, const VisibleSplats& visible, graph::ImageRef distance) {
    const auto& hierarchy = visible.splats.hierarchy;
    const auto directions = visible.directions.directions;
    gl::ProgramSource radiance{{folder + "visible_radiance.comp"}}, unshuffled = radiance;
    unshuffled.defines["UNSHUFFLED"] = "1";
    show_layers(builder, visible,
                {"unshuffle z",
                 "splats.level_depth",
                 {{folder + "visible_depth.comp"}},
                 gl::Format::r32f,
                 true,
                 {hierarchy.places, visible.depth}});
    show_layers(builder, visible,
                {"radiance in sub-images",
                 "splats.radiance",
                 radiance,
                 gl::Format::rgba32f,
                 false,
                 {hierarchy.layout, visible.winner, directions}});
    show_layers(builder, visible,
                {"radiance by level",
                 "splats.level_radiance",
                 unshuffled,
                 gl::Format::rgba32f,
                 true,
                 {hierarchy.places, visible.winner, directions}});
    show_epsilon(builder, visible, distance);
}

}  // namespace ir::methods::deep_screen_space
