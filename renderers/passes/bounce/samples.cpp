#include "renderers/passes/bounce/samples.h"

#include "renderers/graph/output_text.h"
#include "renderers/passes/bounce/tiles.h"

namespace ir::passes::bounce {
namespace {

graph::ImageRef declare(graph::GraphBuilder& builder, graph::ResourceText text, gl::Format format,
                        int samples) {
    graph::ImageDesc desc;
    desc.text = std::move(text);
    desc.format = format;
    desc.layers = samples;
    return builder.image(std::move(desc));
}

OutputDescription incoming(Semantic semantic, std::string unit, std::string doc) {
    return {.key = "bounce.incoming",
            .label = "Incoming",
            .kind = OutputKind::stack,
            .semantic = semantic,
            .unit = std::move(unit),
            .doc = std::move(doc)};
}

OutputDescription incoming_visibility() {
    return incoming(Semantic::accessibility, "",
                    "Whether each sample's ray is open (1) or met something within the maximum distance; "
                    "with the smooth fall-off (d/d_max)². A layer per sample.");
}

OutputDescription incoming_light() {
    return incoming(Semantic::radiance, "W/(m² sr)",
                    "Radiance that arrives along each sample's ray from what it met; black where it met "
                    "nothing. A layer per sample.");
}

OutputDescription incoming_either() {
    return incoming(Semantic::generic, "",
                    "What arrives along each sample's ray, a layer per sample. Ambient occlusion: 1 open, 0 "
                    "closed. Light: radiance of what was met, W/(m² sr), black where nothing was.");
}

graph::ResourceText text_of(const OutputDescription& output) {
    return graph::text_of({output}, output.key);
}

}  // namespace

std::vector<OutputDescription> sample_outputs(const Condition& active_when, Effects effects) {
    auto in = effects == Effects::ambient_occlusion ? incoming_visibility() : incoming_either();
    in.active_when = active_when;
    return {{.key = "bounce.distance",
             .label = "Bounced z",
             .kind = OutputKind::stack,
             .semantic = Semantic::distance,
             .unit = "m",
             .doc = "The bounced z-buffer, a layer per sample: metres from the pixel's point to what its ray "
                    "met first. Negative: nothing.",
             .active_when = active_when},
            in};
}

graph::ImageRef declare_distance(graph::GraphBuilder& builder, int samples) {
    return declare(builder, graph::text_of(sample_outputs({}), "bounce.distance"), gl::Format::r32f, samples);
}

graph::ImageRef declare_incoming_light(graph::GraphBuilder& builder, int samples) {
    return declare(builder, text_of(incoming_light()), gl::Format::rgba32f, samples);
}

graph::ImageRef visibility_of(graph::GraphBuilder& builder, const GBuffer& gbuffer,
                              const Directions& directions, graph::ImageRef distance,
                              const Transport& transport) {
    const auto result =
        declare(builder, text_of(incoming_visibility()), gl::Format::r32f, directions.samples);
    auto pass = builder.pass("visibility");
    pass.reads(gbuffer.geometric_normal)
        .reads("directions", directions.directions)
        .reads("distances", distance)
        .writes("incoming", result);
    execute_by_tiles(pass, builder, [=](graph::PassContext& context) -> const gl::Program& {
        gl::ProgramSource source{{"passes/bounce/visibility.comp"}};
        source.defines["SMOOTH"] = transport.falloff == Transport::Falloff::smooth ? "1" : "0";
        const auto& program = context.use(source);
        program.set("max_distance", transport.max_distance);
        return program;
    });
    return result;
}

}  // namespace ir::passes::bounce
