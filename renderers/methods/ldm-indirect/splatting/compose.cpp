#include <algorithm>
#include <optional>

#include "renderers/methods/ldm-indirect/stages.h"
#include "renderers/passes/direct/direct_light.h"
#include "renderers/passes/direct/seen_light.h"
#include "renderers/passes/gbuffer/glass.h"
#include "renderers/passes/lights/punctual.h"

namespace ir::methods::ldm_indirect {
namespace {

using Paths = Transport::Paths;

/// What the picture is made of.
struct Parts {
    std::optional<graph::ImageRef> direct;  ///< none: not asked for, or all by photons
    std::optional<graph::ImageRef> sky;     ///< what a white surface reflects of the environment
    std::optional<graph::ImageRef> gloss;
    bool splatted, unlit, emission;
    passes::SeenLight seen;
};

/// As direct light photons carry only that of sources without extent.
std::optional<graph::ImageRef> direct_of(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                                         const passes::GBuffer& gbuffer, const Parameters& parameters) {
    auto options = passes::extended_light_options(parameters.light, parameters.transport);
    options.environment = options.environment && parameters.environment_by == EnvironmentBy::samples;
    const auto light = parameters.direct == DirectBy::photons
                           ? passes::extended_light(builder, scene, gbuffer, options)
                           : passes::direct_light(builder, scene, gbuffer, {.extended = options}).radiance;
    if (parameters.transport.paths == Paths::indirect) return {};
    return light;
}

std::map<std::string, std::string> defines_of(const Parts& parts) {
    std::map<std::string, std::string> defines;
    if (parts.splatted) defines["SPLATTED"] = "1";
    if (parts.direct) defines["DIRECT_LIGHT"] = "1";
    if (parts.sky) defines["SKY"] = "1";
    if (parts.gloss) defines["GLOSS"] = "1";
    if (parts.unlit) defines["UNLIT"] = "1";
    if (parts.emission) defines["EMISSION"] = "1";
    if (parts.seen.image) defines["SEEN"] = "1";
    return defines;
}

/// Constants of compose.comp.
struct Compose {
    passes::ReflectionConstants reflection;
    glm::vec3 background;
    IR_FIELDS(reflection, background)
};

}  // namespace

void compose(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const passes::GBuffer& gbuffer,
             const Photons& photons, const Splat& splat, const Parameters& parameters,
             std::optional<graph::ImageRef> gloss) {
    const auto paths = parameters.transport.paths;
    const bool by_photons = parameters.direct == DirectBy::photons;
    Parts parts{.direct = direct_of(builder, scene, gbuffer, parameters),
                .sky = photons.sky,
                .gloss = gloss,
                .splatted = paths != Paths::direct || by_photons,
                .unlit = paths != Paths::indirect && by_photons,
                .emission = paths == Paths::full,
                .seen = passes::seen_light(builder, gbuffer, parameters.transport)};
    const auto radiance = builder.output("radiance", {.format = gl::Format::rgba32f}),
               indirect = builder.output("indirect.radiance", {.format = gl::Format::rgba32f});
    auto receivers = parameters.receivers;
    if (gloss) {
        receivers.receiver = passes::Receiver::diffuse;
        if (by_photons && paths != Paths::indirect &&
            std::ranges::any_of(builder.inputs().world->lights, passes::is_punctual))
            builder.note(
                "direct=photons is diffuse: what is seen has no highlights of point, spot and directional "
                "lights; direct=rasterisation has them");
    }
    const passes::Reflection reflection{.scene = scene,
                                        .gbuffer = gbuffer,
                                        .light = {splat.irradiance, splat.direction, true},
                                        .parameters = receivers,
                                        .materials = parameters.transport.materials,
                                        .is_bare = !gloss};
    gl::ProgramSource source{{"methods/ldm-indirect/splatting/compose.comp"}, defines_of(parts)};
    reflection.define(source);
    auto pass = builder.pass("compose");
    reflection.declare_reads(pass);
    reflection.declare_reads_of_light(pass);
    pass.reads(gbuffer.emission);
    if (parts.direct) pass.reads("direct_image", *parts.direct);
    if (parts.sky) pass.reads("sky_image", *parts.sky);
    if (gloss) pass.reads("gloss_image", *gloss);
    if (parts.seen.image) pass.reads("seen_image", *parts.seen.image);
    pass.writes("radiance_image", radiance)
        .writes("indirect_image", indirect)
        .compute(source, radiance, Compose{reflection.constants(builder.inputs()), parts.seen.background});
    passes::see_through_glass(builder, gbuffer, radiance);
    if (paths != Paths::direct) passes::note_opaque_glass(builder, gbuffer, "layered depth maps");
}

}  // namespace ir::methods::ldm_indirect
