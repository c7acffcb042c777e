#include "renderers/methods/deep-screen-space/splatting/visible.h"

#include "renderers/methods/deep-screen-space/surfels/senders.h"
#include "renderers/methods/deep-screen-space/surfels/view.h"
#include "renderers/passes/bounce/tiles.h"

namespace ir::methods::deep_screen_space {
namespace {

/// Of a stack's layer.
void clear_layer(const gl::Api& gl) {
    constexpr GLuint nobody[4] = {};
    constexpr float farthest = 1;
    gl.ClearBufferuiv(GL_COLOR, 0, nobody);
    gl.ClearBufferfv(GL_DEPTH, 0, &farthest);
}

/// Constants of visible.frag.
struct Visible {
    VisibleLevel of_level;
    int level, sample_index;
    IR_FIELDS(of_level, level, sample_index)
};

/// LESS: of equal depths the first surfel wins, in every run.
const gl::Program& bind_layer(const graph::PassContext& p, const VisibleSplats& visible,
                              const SplatLayer& layer) {
    const int index = layer.sample * visible.splats.hierarchy.levels + layer.level;
    const graph::PassContext::Attachment depth{visible.depth, index};
    p.bind_framebuffer({{visible.winner, index}}, &depth);
    const auto& gl = p.api();
    gl.Disable(GL_BLEND);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
    gl.DepthMask(GL_TRUE);
    if (layer.is_first) clear_layer(gl);
    const auto& program =
        p.use(with_acceptance({{folder + "splat.vert", folder + "visible.frag"}}, visible.splats));
    program.set(Visible{visible_level(visible.splats), layer.level, layer.sample});
    return program;
}

}  // namespace

VisibleLevel visible_level(const Splats& splats) {
    const auto& parameters = splats.parameters;
    return {influence_constants(splats), parameters.coverage, parameters.transport.max_distance,
            parameters.shells == Shells::full_discs};
}

gl::ProgramSource with_acceptance(gl::ProgramSource source, const Splats& splats) {
    source.defines["EXACT"] = splats.parameters.level0 == Level0::triangles ? "1" : "0";
    source.defines["DISCS"] = std::to_string(static_cast<int>(splats.parameters.discs));
    source.defines["CLIPPED"] = splats.parameters.borders == Borders::clipped ? "1" : "0";
    source.defines["OPEN_BACKS"] = splats.parameters.backs == Backs::open ? "1" : "0";
    source.defines["GLASS"] = splats.open_glass ? "1" : "0";
    return source;
}

void read_acceptance(graph::PassBuilder& pass, const VisibleSplats& visible) {
    if (visible.exact.index >= 0) pass.reads("exact_rays", visible.exact);
    if (visible.splats.open_glass) visible.triangles.read_materials_by(pass);
    const auto& parameters = visible.splats.parameters;
    if (parameters.discs != Discs::seen && parameters.borders != Borders::clipped) return;
    pass.reads("BvhNodes", visible.bvh.nodes)
        .reads("BvhTriangles", visible.bvh.triangles)
        .reads("BvhMasks", visible.bvh.masks)
        .reads(visible.scene.opacity, visible.scene.opacity_words);
}

void read_glass(graph::PassBuilder& pass, const VisibleSplats& visible) {
    pass.reads(visible.triangles.vertices).reads("HitIndices", visible.triangles.indices);
    visible.triangles.read_materials_by(pass);
}

namespace {

/// By the rasteriser: a fragment for each surfel that may affect a pixel.
void splat_on_device(graph::GraphBuilder& builder, const VisibleSplats& visible, const std::string& batch) {
    auto pass = builder.pass("splat" + batch);
    pass.has_two_bodies()
        .reads("directions", visible.directions.directions)
        .reads(visible.gbuffer.geometric_normal)
        .writes(visible.depth, visible.winner);
    read_acceptance(pass, visible);
    draw_splats(pass, visible.splats,
                [=](const graph::PassContext& p, const SplatLayer& layer) -> const gl::Program& {
                    return bind_layer(p, visible, layer);
                });
    combine_levels(builder, visible, batch);
}

bool is_of_light(const Parameters& parameters) {
    return parameters.transport.paths != Transport::Paths::ao;
}

void declare_stacks(graph::GraphBuilder& builder, passes::bounce::Batches& batches, VisibleSplats& visible) {
    const auto& splats = visible.splats;
    const auto& hierarchy = splats.hierarchy;
    const auto& parameters = splats.parameters;
    const auto& fingerprint = splats.fingerprint;
    const bool on_host = builder.inputs().processor == Processor::host;
    const auto of_levels = [&](const std::string& key, gl::Format format) {
        return batches.stack(builder,
                             {.text = builder.text_of_output(key),
                              .format = format,
                              .extent = graph::Extent::fixed(hierarchy.width, hierarchy.height),
                              .fingerprint = fingerprint},
                             hierarchy.levels);
    };
    visible.depth = of_levels("splats.depth", gl::Format::depth32f);
    visible.winner = of_levels("splats.winner", gl::Format::r32ui);
    const auto of_samples = [&](graph::ResourceText text, gl::Format format, const std::string& unchanged) {
        return batches.stack(builder, {.text = std::move(text), .format = format, .fingerprint = unchanged});
    };
    const bool exact = parameters.level0 == Level0::triangles;
    if (exact)
        visible.exact = of_samples({.key = "splats.exact",
                                    .label = "Exact rays",
                                    .doc = "Of each sample 1 + the triangle that was met, 0: none; and "
                                           "bits of the distance in m up to which its ray is known."},
                                   gl::Format::rg32ui, fingerprint);
    const std::string of_winning = on_host ? fingerprint : "";
    visible.nearest = of_samples(builder.text_of_output("splats.nearest"), gl::Format::r32ui, of_winning);
    visible.hit_level = of_samples(builder.text_of_output("splats.hit_level"), gl::Format::r16f, of_winning);
    visible.samples.distance = passes::bounce::declare_distance(builder, batches, of_winning);
    const bool light = is_of_light(parameters);
    if (light && !on_host && winners_are_sampled(builder.inputs(), parameters))
        visible.source_light =
            builder.image({.text = {.key = "splats.source_light",
                                    .label = "Light of sources with an extent",
                                    .doc = "That winners send, by one sample each, beyond what discs store.",
                                    .semantic = Semantic::radiance,
                                    .unit = "W/(m² sr)"},
                           .format = gl::Format::rgba32f,
                           .layers = batches.together()});
    using passes::bounce::Effects;
    visible.samples.incoming = passes::bounce::declare_incoming(
        builder, batches, light ? Effects::light : Effects::ambient_occlusion);
}

}  // namespace

VisibleSplats declare_visible(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                              const passes::GBuffer& gbuffer, const passes::ShadowMaps& shadow,
                              const Hierarchy& hierarchy, const Surfels& surfels,
                              const Parameters& parameters, passes::bounce::Batches& batches) {
    VisibleSplats visible;
    visible.splats = declare_splats(builder, hierarchy, surfels, parameters, batches);
    visible.scene = scene;
    visible.shadow = shadow;
    if (needs_triangles(parameters)) visible.bvh = passes::device_bvh(builder);
    if (visible.splats.open_glass) visible.triangles = passes::hit_surfaces(builder, scene);
    visible.gbuffer = gbuffer;
    visible.directions = passes::bounce::declare_directions(builder, batches,
                                                            {.parameters = parameters.directions,
                                                             .light = is_of_light(parameters),
                                                             .materials = parameters.transport.materials,
                                                             .vary = parameters.reprojection.reprojection});
    declare_stacks(builder, batches, visible);
    return visible;
}

void splat_visible(graph::GraphBuilder& builder, VisibleSplats visible, const passes::bounce::Batch& batch) {
    visible.splats.samples = batch.samples;
    visible.splats.first_sample = batch.first;
    const auto& parameters = visible.splats.parameters;
    passes::bounce::choose_directions(builder, visible.scene, visible.gbuffer, visible.directions, batch);
    if (parameters.level0 == Level0::triangles) trace_level0(builder, visible, batch.name);
    if (builder.inputs().processor == Processor::host)
        splat_on_host(builder, visible, batch.name);
    else
        splat_on_device(builder, visible, batch.name);
    if (is_of_light(parameters))
        resolve_light(builder, visible, batch.name);
    else
        passes::bounce::fill_visibility(builder, visible.gbuffer, visible.directions, visible.samples,
                                        parameters.transport, batch);
}

VisibleSplats whole(VisibleSplats visible, const passes::bounce::Batches& batches) {
    for (auto* stack : {&visible.depth, &visible.winner, &visible.exact, &visible.nearest, &visible.hit_level,
                        &visible.directions.directions, &visible.samples.distance, &visible.samples.incoming})
        *stack = batches.whole(*stack);
    visible.splats.samples = visible.directions.samples = batches.samples();
    return visible;
}

void show_visible(graph::GraphBuilder& builder, const VisibleSplats& visible) {
    show_levels(builder, visible);
    show_culling(builder, visible.splats);
}

namespace {

/// Constants of exact.comp.
struct ExactRays {
    InfluenceConstants influence;
    Ideal ideal;
    float max_distance;
    IR_FIELDS(influence, ideal, max_distance)
};

}  // namespace

void trace_level0(graph::GraphBuilder& builder, const VisibleSplats& visible, const std::string& batch) {
    const auto& parameters = visible.splats.parameters;
    auto pass = builder.pass("exact rays of level 0" + batch);
    pass.reads(visible.gbuffer.position, visible.gbuffer.geometric_normal)
        .reads("directions", visible.directions.directions)
        .reads("BvhNodes", visible.bvh.nodes)
        .reads("BvhTriangles", visible.bvh.triangles)
        .reads("BvhMasks", visible.bvh.masks)
        .reads(visible.scene.opacity, visible.scene.opacity_words)
        .writes("exact_image", visible.exact);
    if (visible.splats.open_glass) read_glass(pass, visible);
    gl::ProgramSource source{{folder + "exact.comp"}};
    source.defines["GLASS"] = visible.splats.open_glass ? "1" : "0";
    passes::bounce::compute_by_tiles(
        pass, builder, source,
        ExactRays{influence_constants(visible.splats), ideal(builder.inputs().view, parameters),
                  parameters.transport.max_distance});
}

namespace {

/// Constants of combine.comp.
struct Combine {
    int levels, samples;
    bool nearest_decides;
    IR_FIELDS(levels, samples, nearest_decides)
};

}  // namespace

void combine_levels(graph::GraphBuilder& builder, const VisibleSplats& visible, const std::string& batch) {
    auto pass = builder.pass("combine levels" + batch);
    pass.reads("Surfels", visible.splats.surfels.records)
        .reads("places", visible.splats.hierarchy.places)
        .reads("winners", visible.winner)
        .reads("depths", visible.depth)
        .reads(visible.gbuffer.position)
        .reads("directions", visible.directions.directions);
    if (visible.exact.index >= 0) pass.reads("exact_rays", visible.exact);
    pass.writes("distance_image", visible.samples.distance)
        .writes("nearest_image", visible.nearest)
        .writes("level_image", visible.hit_level);
    passes::bounce::compute_by_tiles(
        pass, builder, with_acceptance({{folder + "combine.comp"}}, visible.splats),
        Combine{visible.splats.hierarchy.levels, visible.splats.samples, nearest_decides(visible.splats)});
}

namespace {

/// Constants of resolve.comp.
struct Resolve {
    SenderConstants senders;
    VisibleLevel rules;
    int levels, first_sample;
    unsigned seed;
    float highlight_share;
    IR_FIELDS(senders, rules, levels, first_sample, seed, highlight_share)
};

struct Senders {
    bool glossy, exact;
    SenderInputs inputs = {};  ///< only where senders are looked up again

    bool are_looked_up() const { return glossy || exact; }
};

gl::ProgramSource source_of(const VisibleSplats& visible, const Senders& senders) {
    const auto& parameters = visible.splats.parameters;
    gl::ProgramSource source{{"methods/deep-screen-space/splatting/resolve.comp"}};
    source.defines["AVERAGED"] = parameters.disc_light == DiscLight::averaged ? "1" : "0";
    source.defines["BLACK_BACKS"] = parameters.backs == Backs::black ? "1" : "0";
    source.defines["GLOSSY_SENDERS"] = senders.glossy ? "1" : "0";
    source.defines["EXACT"] = senders.exact ? "1" : "0";
    source.defines["EXTENDED"] = visible.source_light.index >= 0 ? "1" : "0";
    source.defines["GLASS"] = visible.splats.open_glass ? "1" : "0";
    source.defines["MATERIALS"] = std::to_string(static_cast<int>(parameters.transport.materials));
    return source;
}

}  // namespace

void resolve_light(graph::GraphBuilder& builder, const VisibleSplats& visible, const std::string& batch) {
    const auto& parameters = visible.splats.parameters;
    if (builder.inputs().processor == Processor::host) {
        resolve_light_on_host(builder, visible, batch);
        return;
    }
    Senders senders{sends_highlights(parameters), parameters.level0 == Level0::triangles};
    if (visible.source_light.index >= 0) sample_winners_sources(builder, visible, batch);
    if (senders.are_looked_up()) senders.inputs = sender_inputs(builder, visible.scene, visible.shadow);
    auto pass = builder.pass("light of the winners" + batch);
    pass.has_two_bodies();
    pass.reads("Surfels", visible.splats.surfels.records)
        .reads("Stored", visible.splats.surfels.stored)
        .reads("SurfelLights", visible.splats.surfels.lights)
        .reads(visible.gbuffer.position)
        .reads("nearest", visible.nearest)
        .reads("directions", visible.directions.directions)
        .writes("incoming", visible.samples.incoming);
    if (senders.exact) pass.reads("distances", visible.samples.distance);
    if (visible.source_light.index >= 0) pass.reads("source_light", visible.source_light);
    if (senders.are_looked_up())
        senders.inputs.read_by(pass);
    else if (visible.splats.open_glass)
        read_glass(pass, visible);
    passes::bounce::compute_by_tiles(
        pass, builder, source_of(visible, senders),
        Resolve{sender_constants(builder.inputs(), parameters), visible_level(visible.splats),
                visible.splats.hierarchy.levels, visible.splats.first_sample,
                random_seed(builder.inputs(), parameters), highlight_share(parameters)});
}

}  // namespace ir::methods::deep_screen_space
