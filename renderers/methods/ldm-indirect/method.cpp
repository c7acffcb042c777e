// Indirect light from layered depth maps: every pixel of a light's image is a photon with its differential,
// as is every ray from a source with an extent. Photons are split at their first surface into all directions
// of the maps, traced through them, and splatted onto what the camera sees. [Aalund15 §3.4, §4.2]
#include "renderers/graph/method.h"

#include "renderers/methods/ldm-indirect/gloss/gloss.h"
#include "renderers/methods/ldm-indirect/stages.h"
#include "renderers/methods/ldm-indirect/tracing/one_pass.h"

namespace ir::methods::ldm_indirect {
namespace {

/// Of sources with an extent all direct light is sampled; that of the environment may be the maps' instead.
std::vector<MissingLight> missing_light() {
    auto environment = passes::without_light_samples({LightPart::direct}, {LightKind::environment});
    environment.active_when.push_back({"environment_by", {std::string("samples")}});
    return {passes::without_light_samples({LightPart::direct}, {LightKind::lamp, LightKind::surface}),
            environment};
}

MethodDescription description() {
    MethodDescription d;
    d.id = "ldm-indirect";
    d.title = "Indirect light from layered depth maps";
    d.summary =
        "Splits photons of all sources into all directions of the layered depth maps, traces them "
        "through the maps, and splats them with the footprints of their differentials. Bounces are diffuse; "
        "interfaces that are seen look at the scene. Nothing is precomputed. Errors come from the number of "
        "directions, from the maps' texels and from the footprints' size. To maps glass is opaque.";
    d.version = 8;
    d.papers = {"Aalund15", "Igehy99", "Frisvad14"};
    d.missing_light = missing_light();
    d.outputs =
        joined({splatting_outputs(), gloss_outputs(), tracing_outputs(), effect_outputs(), trace_outputs()});
    d.selectors = tracing_selectors();
    return d;
}

void setup(graph::GraphBuilder& builder, const Parameters& given) {
    auto parameters = of_frame(given, builder.inputs());
    if (const auto reason = needs_storing(parameters);
        !reason.empty() && parameters.splatting == Splatting::one_pass) {
        builder.note("splatting=one-pass stores no photons: image-atomics are used for " + reason);
        parameters.splatting = Splatting::image_atomics;
    }
    const auto scene = passes::upload_scene(builder);
    const auto gbuffer = passes::gbuffer(builder, scene, passes::gbuffer_options(parameters.transport));
    const auto photons = trace_photons(builder, scene, gbuffer, parameters);
    const auto splat = splat_photons(builder, gbuffer, photons, parameters);
    const auto gloss = reflect_gloss(builder, scene, gbuffer, photons, parameters);
    compose(builder, scene, gbuffer, photons, splat, parameters, gloss);
    const auto pixel = explain(builder, gbuffer, photons, splat, parameters);
    show_effects(builder, gbuffer, photons, splat, pixel, parameters);
    explain_trace(builder, photons, pixel);
}

}  // namespace

const graph::Method& method() {
    static const auto method =
        graph::make_method<Parameters>(description(), parameter_table(), setup, benchmarks());
    return method;
}

}  // namespace ir::methods::ldm_indirect
