#include "renderers/passes/blur/blur.h"

#include "renderers/graph/pass_context.h"

namespace ir::passes {
namespace {

using graph::ImageRef;

ImageRef declare(graph::GraphBuilder& builder, graph::ResourceText text, gl::Format format) {
    graph::ImageDesc desc;
    desc.text = std::move(text);
    desc.format = format;
    return builder.image(std::move(desc));
}

/// Constants of blur.comp.
struct Blur {
    glm::ivec2 axis;
    int radius;
    float plane_tolerance, normal_power;
    IR_FIELDS(axis, radius, plane_tolerance, normal_power)
};

void blur_axis(graph::GraphBuilder& builder, const std::string& name, const GBuffer& gbuffer, ImageRef from,
               ImageRef to, const BlurParameters& parameters, glm::ivec2 axis) {
    auto pass = builder.pass(name);
    pass.reads("image", from)
        .reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal)
        .writes("result", to);
    pass.compute({{"passes/blur/blur.comp"}}, to,
                 Blur{axis, parameters.used_radius(), parameters.plane_tolerance, parameters.normal_power});
}

}  // namespace

ImageRef blur(graph::GraphBuilder& builder, const GBuffer& gbuffer, ImageRef image,
              const BlurParameters& parameters, graph::ResourceText text) {
    const auto format = builder.images().at(static_cast<std::size_t>(image.index)).format;
    auto half = text;
    half.key += ".blurred_rows";
    half.label += ", rows blurred";
    half.doc = "After the first of two passes of the blur.";
    const auto key = text.key;
    const auto rows = declare(builder, std::move(half), format);
    const auto result = declare(builder, std::move(text), format);
    blur_axis(builder, "blur rows: " + key, gbuffer, image, rows, parameters, {1, 0});
    blur_axis(builder, "blur columns: " + key, gbuffer, rows, result, parameters, {0, 1});
    return result;
}

ParameterTable<BlurParameters> blur_parameters(int max_radius) {
    const Condition blurred{"blur", {true}};
    ParameterTable<BlurParameters> table;
    table
        .add(&BlurParameters::blur,
             {.key = "blur",
              .label = "Blur",
              .doc = "Averages over neighbouring pixels of the same surface, which takes away the pattern "
                     "that turned directions leave."})
        .add(&BlurParameters::radius, {.key = "blur_radius",
                                       .label = "Blur radius",
                                       .doc = "Pixels on either side that are averaged.",
                                       .unit = "px",
                                       .hard = {0, static_cast<double>(max_radius)},
                                       .soft = {1, 16},
                                       .active_when = blurred})
        .add(&BlurParameters::plane_tolerance,
             {.key = "blur_plane_tolerance",
              .label = "Blur off the plane",
              .doc = "Sine of the angle off the pixel's tangent plane at which a neighbour's weight has "
                     "fallen to 1/e. Small values keep the blur within one plane.",
              .hard = {1e-4, 1e3},
              .soft = {0.01, 1},
              .active_when = blurred})
        .add(&BlurParameters::normal_power,
             {.key = "blur_normal_power",
              .label = "Blur across normals",
              .doc = "Power of the cosine between shading normals in a neighbour's weight. 0: normals do "
                     "not count.",
              .hard = {0, 1e4},
              .soft = {0, 128},
              .active_when = blurred});
    return table;
}

}  // namespace ir::passes
