#include "renderers/methods/hbao/passes.h"

#include "renderers/core/record.h"
#include "shaders/methods/hbao/explain.comp.h"

namespace ir::methods::hbao {
namespace {

/// Constants of explain.comp.
struct Explain {
    MarchConstants march;
    glm::ivec2 picked;
    IR_FIELDS(march, picked)
};

}  // namespace

std::vector<OutputDescription> explanation_outputs() {
    return {
        {.key = "hbao.explain.horizons",
         .label = "Horizons",
         .kind = OutputKind::sphere_values,
         .doc =
             "Where the horizon of each marched direction lies on the sphere. horizon, tangent: elevations "
             "in degrees of the horizon and of the triangle's plane above the plane across the line of "
             "sight; contribution: what the direction adds to the pixel's accessibility before the blur; "
             "distance: metres to the sample that made the horizon, 0 where there is none.",
         .when_empty = no_surface,
         .explains = true},
        {.key = "hbao.explain.lines",
         .label = "Lines to the horizon",
         .kind = OutputKind::line_set,
         .unit = "m",
         .doc = "From the pixel's point to the sample that made each direction's horizon; without length "
                "where there is none. distance and contribution as for the horizons.",
         .categories = {{"found", {{0, "no horizon", tints::grey}, {1, "horizon", tints::orange}}}},
         .when_empty = no_surface,
         .explains = true},
        {.key = "hbao.explain.samples",
         .label = "Samples marched",
         .kind = OutputKind::point_set,
         .semantic = Semantic::position,
         .unit = "m",
         .doc = "What was looked at, direction by direction. Without a surface it is shown at the pixel's "
                "depth. Not counted is what lies beyond the radius or below the angle bias, and the pixel "
                "itself. elevation: degrees above the plane across the line of sight; taken: what the sample "
                "takes from the pixel's accessibility before the blur.",
         .categories = {{"role",
                         {{0, "no surface", tints::dark},
                          {1, "not counted", tints::grey},
                          {2, "below the horizon so far", tints::sky},
                          {3, "raises the horizon", tints::orange}}}},
         .when_empty = no_surface,
         .explains = true},
    };
}

SelectorDescription direction_selector() {
    return {.key = "direction",
            .label = "Direction",
            .doc = "One of the directions in the picture that are marched from the pixel.",
            .parameter = "directions"};
}

void explain(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Parameters& parameters) {
    const auto directions = static_cast<std::uint64_t>(parameters.directions);
    const auto horizons = builder.explanation("hbao.explain.horizons",
                                              {.fields = record_fields<Horizon>(), .elements = directions}),
               lines = builder.explanation(
                   "hbao.explain.lines", {.fields = record_fields<LineToHorizon>(), .elements = directions}),
               samples = builder.explanation(
                   "hbao.explain.samples",
                   {.fields = record_fields<SampleMarched>(),
                    .elements = directions * static_cast<std::uint64_t>(parameters.steps)});
    const auto& view = builder.inputs().view;
    auto pass = builder.pass("explain");
    pass.reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal);
    pass.writes("Horizons", horizons.elements).counts("HorizonCount", horizons.count);
    pass.writes("Lines", lines.elements).counts("LineCount", lines.count);
    pass.writes("Samples", samples.elements).counts("SampleCount", samples.count);
    pass.compute({{"methods/hbao/explain.comp"}}, 1,
                 Explain{march_constants(view), builder.inputs().picked_pixel()});
}

}  // namespace ir::methods::hbao
