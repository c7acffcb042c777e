#include "renderers/methods/ssdo/passes.h"

#include "renderers/graph/pass_context.h"

namespace ir::methods::ssdo {
namespace {

graph::ImageRef declare(graph::GraphBuilder& builder, graph::ResourceText text) {
    graph::ImageDesc desc;
    desc.text = std::move(text);
    desc.format = gl::Format::rgba32f;
    return builder.image(std::move(desc));
}

/// Divides by the materials' reflectance, or multiplies with it.
void modulate(graph::GraphBuilder& builder, const std::string& name, const passes::GBuffer& gbuffer,
              graph::ImageRef from, graph::ImageRef to, bool remove) {
    gl::ProgramSource source{{"methods/ssdo/modulate.comp"}};
    if (remove) source.defines["REMOVE"] = "1";
    builder.pass(name)
        .reads("from_image", from)
        .reads(gbuffer.albedo, gbuffer.material)
        .writes("to_image", to)
        .compute(source, to);
}

}  // namespace

graph::ImageRef blurred(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, graph::ImageRef raw,
                        const std::string& key, const Parameters& parameters) {
    const auto text = builder.text_of_output(key);
    const auto bare =
        declare(builder, {key + ".bare", text.label + ", without materials", "Before the blur."});
    modulate(builder, "remove materials: " + key, gbuffer, raw, bare, true);
    const auto even = passes::blur(builder, gbuffer, bare, parameters.blur,
                                   {key + ".even", text.label + ", blurred without materials"});
    const auto result = builder.output(key, {.format = gl::Format::rgba32f});
    modulate(builder, "put materials back: " + key, gbuffer, even, result, false);
    return result;
}

Lit add_sky(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const passes::DirectLight& direct,
            const graph::ImageRef* sky) {
    const Lit lit{builder.output("ssdo.direct", {.format = gl::Format::rgba32f}),
                  builder.output("ssdo.senders", {.format = gl::Format::rgba32f})};
    const bool has_sky = sky != nullptr;
    const auto added = has_sky ? *sky : direct.radiance;
    gl::ProgramSource source{{"methods/ssdo/direct.comp"}};
    if (has_sky) source.defines["SKY"] = "1";
    builder.pass("add environment light")
        .reads("direct_image", direct.radiance)
        .reads("sky_image", added)
        .reads(gbuffer.material)
        .writes("seen", lit.seen)
        .writes("sent", lit.senders)
        .compute(source, lit.seen);
    return lit;
}

std::vector<OutputDescription> light_outputs() {
    const auto radiance = [](std::string key, std::string label, std::string doc,
                             const Condition& active_when = {}) {
        return OutputDescription{.key = std::move(key),
                                 .label = std::move(label),
                                 .semantic = Semantic::radiance,
                                 .unit = "W/(m² sr)",
                                 .doc = std::move(doc),
                                 .active_when = active_when};
    };
    return {
        radiance("ssdo.indirect", "Indirect light", "Reflected to the eye of what occluders send, blurred."),
        radiance("ssdo.sky", "Environment light",
                 "Reflected to the eye of the environment, as far as samples find it open, blurred.",
                 by_occlusion),
        radiance("ssdo.direct", "Direct light and environment",
                 "All light sources, the environment by samples or directional occlusion; and the base "
                 "colour of unlit surfaces."),
        radiance("ssdo.senders", "What pixels send",
                 "Direct light without unlit surfaces: what an occluder's pixel sends in all directions."),
    };
}

}  // namespace ir::methods::ssdo
