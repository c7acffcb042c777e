#include "renderers/methods/photon-mapping/splatting/overlay.h"

#include <algorithm>
#include <array>

#include "renderers/graph/pass_context.h"
#include "renderers/image/colour_map.h"
#include "renderers/methods/photon-mapping/bounces.h"
#include "renderers/methods/photon-mapping/splatting/splat_view.h"
#include "renderers/methods/photon-mapping/splatting/stages.h"

namespace ir::methods::photon_mapping {
namespace {

/// Rows of a picture for each pixel of a dot's side, and the least side: single pixels are overlooked.
constexpr int rows_of_a_dot = 360, min_dot = 2;

/// Constants of overlay_dots.comp.
struct MarkPhotons {
    SplatView view;
    int dot_size;
    IR_FIELDS(view, dot_size)
};

/// Constants of overlay.frag.
struct Overlay {
    glm::vec3 view_axis_ws;
    std::array<glm::vec4, 8> mark_colours;
    IR_FIELDS(view_axis_ws, mark_colours)
};

/// Linear.
std::array<glm::vec4, 8> linear(const Categories& named) {
    std::array<glm::vec4, 8> colours{};
    for (std::size_t i = 0; i < colours.size(); ++i)
        colours[i] = glm::vec4(linear_from_srgb(named.values.at(i).colour), 0);
    return colours;
}

void mark_dots(const graph::PassContext& p, graph::Slice slice, const StoredPhotons& photons,
               graph::ImageRef dots) {
    if (slice.first) p.clear(dots);
    const auto& program = p.use({{"methods/photon-mapping/splatting/overlay_dots.comp"}});
    const auto& view = p.inputs().view;
    program.set(MarkPhotons{splat_view(view, 1), std::max(min_dot, view.height / rows_of_a_dot)});
    passes::dispatch_photons(p, program, photons, slice);
}

}  // namespace

void draw_marks(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, graph::ImageRef marks,
                const std::string& key, const Categories& colours) {
    const auto overlay = builder.output(key, {.format = gl::Format::rgba16f});
    builder.pass(builder.text_of_output(key).label)
        .reads("marks", marks)
        .reads(gbuffer.albedo, gbuffer.normal)
        .draw({{"methods/photon-mapping/splatting/overlay.frag"}}, overlay,
              Overlay{-glm::vec3(glm::transpose(builder.inputs().view.view_from_world)[2]), linear(colours)});
}

void draw_overlay(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                  const StoredPhotons& photons) {
    const auto dots = builder.image(
        {.text = {.key = "photons.dots",
                  .label = "Dots of photons",
                  .doc = "The bounce in the low four bits, above it the random number by which this photon's "
                         "dot won; 0: none.",
                  .semantic = Semantic::id},
         .format = gl::Format::r32ui});
    builder.pass("mark photons")
        .reads(gbuffer.position)
        .reads("Photons", photons.records)
        .reads("Stored", photons.stored)
        .writes("dots", dots)
        .execute_sliced(passes::photon_parts, [=](graph::PassContext& p, graph::Slice slice) {
            mark_dots(p, slice, photons, dots);
        });
    draw_marks(builder, gbuffer, dots, "photons.overlay", bounce_categories(""));
}

}  // namespace ir::methods::photon_mapping
