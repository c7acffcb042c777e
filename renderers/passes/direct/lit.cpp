#include "renderers/passes/direct/lit.h"

#include "renderers/graph/output_text.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/gbuffer/glass.h"

namespace ir::passes {

OutputDescription lit_output() {
    return {.key = "lit",
            .label = "Lit",
            .semantic = Semantic::radiance,
            .unit = "W/(m² sr)",
            .doc =
                "Direct light with shadow maps, emission, and ambient radiance times albedo times "
                "accessibility."};
}

ParameterText ambient_parameter() {
    return {.key = "ambient",
            .label = "Ambient radiance",
            .doc =
                "Radiance from all directions that accessibility attenuates, in the "
                "output “lit”.",
            .unit = "W/(m² sr)",
            .hard = {0, 1e6},
            .soft = {0, 2}};
}

graph::ImageRef lit(graph::GraphBuilder& builder, const GBuffer& gbuffer, const DirectLight& direct,
                    graph::ImageRef accessibility, float ambient) {
    graph::ImageDesc desc;
    desc.text = graph::text_of({lit_output()}, "lit");
    desc.format = gl::Format::rgba32f;
    const auto result = builder.image(std::move(desc));
    const std::vector<graph::ImageRef> sources{accessibility, direct.radiance, gbuffer.albedo,
                                               gbuffer.emission, gbuffer.geometric_normal};
    auto pass = builder.pass("lit");
    for (const auto source : sources) pass.reads(source);
    pass.writes(result).execute([sources, result, ambient](graph::PassContext& context) {
        const auto& program = context.program({{"passes/direct/lit.comp"}});
        program.use();
        for (std::size_t i = 0; i < sources.size(); ++i)
            context.bind_texture(static_cast<int>(i), sources[i]);
        context.bind_storage_image(0, result);
        program.set("ambient", ambient);
        const auto shape = context.shape(result);
        program.dispatch(shape.width, shape.height);
    });
    see_through_glass(builder, gbuffer, result);
    return result;
}

}  // namespace ir::passes
