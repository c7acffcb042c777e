#include "renderers/passes/direct/compose.h"

#include <optional>
#include <stdexcept>

#include "renderers/passes/direct/seen_light.h"
#include "renderers/passes/gbuffer/glass.h"
#include "renderers/passes/lights/shining.h"

namespace ir::passes {
namespace {

using Paths = Transport::Paths;

/// What the picture is made of; what the paths leave out is none.
struct Parts {
    graph::ImageRef geometric_normal;
    std::optional<graph::ImageRef> indirect = {}, direct = {}, emission = {};
    SeenLight seen;
};

/// Constants of compose.comp.
struct Compose {
    glm::vec3 background;
    IR_FIELDS(background)
};

gl::ProgramSource source_of(const Parts& parts) {
    gl::ProgramSource source{{"passes/direct/compose.comp"}};
    if (parts.indirect) source.defines["INDIRECT"] = "1";
    if (parts.direct) source.defines["DIRECT"] = "1";
    if (parts.emission) source.defines["EMISSION"] = "1";
    if (parts.seen.image) source.defines["SEEN"] = "1";
    return source;
}

}  // namespace

OutputDescription radiance_output(const Condition& active_when) {
    return {.key = "radiance",
            .label = "Radiance",
            .semantic = Semantic::radiance,
            .unit = "W/(m² sr)",
            .doc = "Towards the eye: emission, direct light and indirect light, as the paths say.",
            .active_when = active_when};
}

graph::ImageRef compose_light(graph::GraphBuilder& builder, const GBuffer& gbuffer, const DirectLight& direct,
                              graph::ImageRef indirect, const Transport& transport) {
    const auto paths = transport.paths;
    if (paths == Paths::ao) throw std::logic_error("compose_light: ambient occlusion is no radiance");
    note_darkness(builder, transport);
    Parts parts{.geometric_normal = gbuffer.geometric_normal,
                .seen = seen_light(builder, gbuffer, transport)};
    if (paths != Paths::direct) parts.indirect = indirect;
    if (paths != Paths::indirect) parts.direct = direct.radiance;
    if (paths == Paths::full) parts.emission = gbuffer.emission;
    const auto radiance = builder.output("radiance", {.format = gl::Format::rgba32f});
    auto pass = builder.pass("compose");
    pass.reads(parts.geometric_normal);
    if (parts.indirect) pass.reads("indirect_image", *parts.indirect);
    if (parts.direct) pass.reads("direct_image", *parts.direct);
    if (parts.emission) pass.reads(*parts.emission);
    if (parts.seen.image) pass.reads("seen_image", *parts.seen.image);
    pass.writes("radiance_image", radiance)
        .compute(source_of(parts), radiance, Compose{parts.seen.background});
    see_through_glass(builder, gbuffer, radiance);
    return radiance;
}

}  // namespace ir::passes
