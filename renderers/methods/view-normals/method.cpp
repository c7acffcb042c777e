// The smallest whole method; copy this folder and shaders/methods/view-normals to begin another.
#include "renderers/graph/method.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::methods::view_normals {
namespace {

// 1. The parameters. The initialisers here are the only place for defaults.
enum class Source { shading, geometric };
struct Parameters {
    Source source = Source::shading;
    bool as_colour = false;
};

// 2. What people, files and shaders need to know about them.
ParameterTable<Parameters> parameters() {
    ParameterTable<Parameters> table;
    table.add(&Parameters::source,
              {.key = "source",
               .label = "Source",
               .doc = "Which normal is shown.",
               .choices = {{"shading", "Shading", "Interpolated between vertices, with normal maps."},
                           {"geometric", "Geometric", "Of the triangle's plane."}}});
    return table.add(&Parameters::as_colour, {.key = "as_colour", .label = "As colour", .doc = "In [0, 1]."});
}

// 3. What the method is, and what it shows of itself. The first output is the main result.
MethodDescription description() {
    const std::string doc = "Unit length; x to the right, y up, z to the viewer. Background is 0.";
    return {.id = "view-normals",
            .title = "Normals in view space",
            .summary = "Normals relative to the camera, no light: the example that methods are begun from.",
            .outputs = {{.key = "normal", .label = "Normal", .semantic = Semantic::normal, .doc = doc}}};
}

// 4. What else the shader knows: a uniform for each field.
struct Constants {
    glm::mat4 view_from_world;
    IR_FIELDS(view_from_world)
};

// 5. One frame: resources and passes. Nothing runs here; passes run later, in this order.
void setup(graph::GraphBuilder& builder, const Parameters& p) {
    const auto gbuffer = passes::gbuffer(builder, passes::upload_scene(builder));
    const auto normal = builder.output("normal", {.format = gl::Format::rgba16f});
    builder.pass("view normals")
        .reads("normal_image", p.source == Source::shading ? gbuffer.normal : gbuffer.geometric_normal)
        .draw({{"methods/view-normals/view_normals.frag"}}, normal,
              Constants{builder.inputs().view.view_from_world});
}

}  // namespace

// 6. The one name that the generated registry asks for.
const graph::Method& method() {
    static const auto method = graph::make_method<Parameters>(description(), parameters(), setup);
    return method;
}

}  // namespace ir::methods::view_normals
