#include "renderers/methods/hbao/explain.h"

#include <algorithm>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/hbao/passes.h"

namespace ir::methods::hbao {
namespace {

using graph::Field;
using graph::FieldType;

const std::string no_surface = "the pixel shows no surface";

struct Explained {
    graph::BufferRef elements;
    graph::CounterRef count;
};

Explained declare(graph::GraphBuilder& builder, const std::string& what, OutputKind kind,
                  std::vector<Field> fields, std::uint64_t elements) {
    const auto text = builder.text_of_output("hbao.explain." + what);
    Explained e;
    // Growable, so that counters tell how many elements are in use.
    e.elements = builder.buffer(
        {.text = text, .kind = kind, .fields = std::move(fields), .elements = elements, .growable = true});
    e.count = builder.counter({.key = "hbao.explain." + what + "_count",
                               .label = text.label,
                               .doc = "0 while no pixel is picked, and where the pixel shows no surface.",
                               .growth_of = e.elements});
    return e;
}

Explained declare_horizons(graph::GraphBuilder& builder, std::uint64_t directions) {
    return declare(builder, "horizons", OutputKind::sphere_values,
                   {{"centre", FieldType::f32, 3},
                    {"horizon", FieldType::f32},
                    {"tangent", FieldType::f32},
                    {"contribution", FieldType::f32},
                    {"distance", FieldType::f32},
                    {"direction", FieldType::u32}},
                   directions);
}

Explained declare_lines(graph::GraphBuilder& builder, std::uint64_t directions) {
    return declare(builder, "lines", OutputKind::line_set,
                   {{"start", FieldType::f32, 3},
                    {"end", FieldType::f32, 3},
                    {"found", FieldType::u32},
                    {"distance", FieldType::f32},
                    {"contribution", FieldType::f32},
                    {"direction", FieldType::u32}},
                   directions);
}

Explained declare_samples(graph::GraphBuilder& builder, std::uint64_t samples) {
    return declare(builder, "samples", OutputKind::point_set,
                   {{"position", FieldType::f32, 3},
                    {"role", FieldType::u32},
                    {"distance", FieldType::f32},
                    {"elevation", FieldType::f32},
                    {"taken", FieldType::f32},
                    {"direction", FieldType::u32},
                    {"step", FieldType::u32}},
                   samples);
}

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
                "where found is 0. distance and contribution as for the horizons.",
         .when_empty = no_surface,
         .explains = true},
        {.key = "hbao.explain.samples",
         .label = "Samples marched",
         .kind = OutputKind::point_set,
         .semantic = Semantic::position,
         .unit = "m",
         .doc =
             "What was looked at, direction by direction. role: 0 no surface, shown at the pixel's depth; 1 "
             "not counted: beyond the radius, the pixel itself, or below the angle bias; 2 below the "
             "horizon so far; 3 raises it. elevation: degrees above the plane across the line of sight; "
             "taken: what the sample takes from the pixel's accessibility before the blur.",
         .when_empty = no_surface,
         .explains = true},
    };
}

SelectorDescription direction_selector() {
    return {.key = "direction",
            .label = "Direction",
            .doc = "One of the directions in the picture that are marched from the pixel.",
            .count = "directions"};
}

void explain(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Parameters& parameters) {
    const auto directions = static_cast<std::uint64_t>(parameters.directions);
    const auto horizons = declare_horizons(builder, directions), lines = declare_lines(builder, directions),
               samples = declare_samples(builder, directions * static_cast<std::uint64_t>(parameters.steps));
    auto pass = builder.pass("explain");
    pass.reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal);
    pass.writes("Horizons", horizons.elements).counts("HorizonCount", horizons.count);
    pass.writes("Lines", lines.elements).counts("LineCount", lines.count);
    pass.writes("Samples", samples.elements).counts("SampleCount", samples.count);
    pass.execute([=](graph::PassContext& context) {
        const auto& program = context.use({{"methods/hbao/explain.comp"}});
        set_march(context, program);
        const auto& inputs = context.inputs();
        const auto& picked = inputs.inspection;
        const bool inside =
            picked.has_pixel() && picked.x < inputs.view.width && picked.y < inputs.view.height;
        program.set("picked", inside ? glm::ivec2(picked.x, picked.y) : glm::ivec2(-1));
        program.dispatch(1);
    });
}

}  // namespace ir::methods::hbao
