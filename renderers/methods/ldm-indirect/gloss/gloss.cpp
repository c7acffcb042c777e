#include "renderers/methods/ldm-indirect/gloss/gloss.h"

#include "renderers/graph/pass_context.h"
#include "renderers/passes/direct/direct_light.h"
#include "renderers/passes/scene/progressive.h"

namespace ir::methods::ldm_indirect {
namespace {

bool is_on_device(const graph::GraphBuilder& builder, const Parameters& parameters) {
    return parameters.gloss.tracer == GlossTracer::rays &&
           passes::samples_on_device(builder.inputs(),
                                     passes::extended_light_options(parameters.light, parameters.transport));
}

/// No surface has an interface: what is listed is 0.
void reflect_nothing(graph::GraphBuilder& builder, const GlossImages& images) {
    builder.pass("no gloss")
        .writes(images.radiance, images.error, images.distance)
        .execute([images](graph::PassContext& context) {
            for (const auto image : {images.radiance, images.error, images.distance}) context.clear(image);
        });
}

}  // namespace

float highlight_share(const graph::FrameInputs& inputs, const Parameters& parameters) {
    const int frames = parameters.progressive ? passes::frames_standing(inputs) + 1 : 1;
    return parameters.gloss.highlight_rays / static_cast<float>(parameters.gloss.samples * frames);
}

std::optional<graph::ImageRef> reflect_gloss(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                                             const passes::GBuffer& gbuffer, const Photons& photons,
                                             const Parameters& parameters) {
    if (parameters.gloss.kind == Gloss::none || parameters.transport.paths == Transport::Paths::direct)
        return {};
    const GlossImages images{builder.output("gloss.radiance", {.format = gl::Format::rgba32f}),
                             builder.output("gloss.error", {.format = gl::Format::r32f}),
                             builder.output("gloss.distance", {.format = gl::Format::r32f})};
    if (parameters.transport.materials == Transport::Materials::lambert) {
        reflect_nothing(builder, images);
        return {};
    }
    if (is_on_device(builder, parameters))
        reflect_on_device(builder, scene, gbuffer, images, parameters);
    else
        reflect_on_host(builder, gbuffer, photons.maps, images, parameters);
    return images.radiance;
}

}  // namespace ir::methods::ldm_indirect
