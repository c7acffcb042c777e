#include "renderers/methods/photon-mapping/splatting/overlay.h"

#include <algorithm>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/photon-mapping/splatting/outputs.h"
#include "renderers/methods/photon-mapping/splatting/splat_view.h"

namespace ir::methods::photon_mapping {
namespace {

/// Rows of a picture for each pixel of a dot's side, and the least side: single pixels are overlooked.
constexpr int rows_of_a_dot = 360, least_dot = 2;

void mark_dots(const graph::PassContext& p, graph::Slice slice, const passes::GBuffer& gbuffer,
               const StoredPhotons& photons, graph::ImageRef dots) {
    if (slice.first) p.clear(dots);
    const auto& program = p.program({{"methods/photon-mapping/splatting/overlay_dots.comp"}});
    program.use();
    set_splat_view(program, p.inputs(), 1);
    program.set("dot_size", std::max(least_dot, p.inputs().view.height / rows_of_a_dot));
    p.bind_buffer(0, photons.records);
    p.bind_buffer(1, photons.stored);
    p.bind_texture(0, gbuffer.position);
    p.bind_storage_image(0, dots);
    dispatch_photons(p, program, photons, slice);
}

void colour(const graph::PassContext& p, const passes::GBuffer& gbuffer, graph::ImageRef dots,
            graph::ImageRef overlay) {
    p.bind_framebuffer({{overlay}});
    const auto& program =
        p.program({{"lib/full_screen.vert", "methods/photon-mapping/splatting/overlay.frag"}});
    program.use();
    program.set("view_axis_ws", -glm::vec3(glm::transpose(p.inputs().view.view_from_world)[2]));
    p.bind_texture(0, dots);
    p.bind_texture(1, gbuffer.albedo);
    p.bind_texture(2, gbuffer.normal);
    p.draw_full_screen();
}

}  // namespace

void draw_overlay(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                  const StoredPhotons& photons) {
    graph::ImageDesc desc;
    desc.text = {.key = "photons.dots",
                 .label = "Dots of photons",
                 .doc =
                     "The bounce in the low four bits, above it the random number by which this photon's "
                     "dot won; 0: none.",
                 .semantic = Semantic::id};
    desc.format = gl::Format::r32ui;
    const auto dots = builder.image(desc);
    desc.text = text_of_output("photons.overlay");
    desc.format = gl::Format::rgba16f;
    const auto overlay = builder.image(desc);
    builder.pass("mark photons")
        .reads(gbuffer.position, photons.records, photons.stored)
        .writes(dots)
        .execute_sliced(photon_parts, [=](graph::PassContext& p, graph::Slice slice) {
            mark_dots(p, slice, gbuffer, photons, dots);
        });
    builder.pass("photons over the picture")
        .reads(dots, gbuffer.albedo, gbuffer.normal)
        .writes(overlay)
        .execute([=](graph::PassContext& p) { colour(p, gbuffer, dots, overlay); });
}

}  // namespace ir::methods::photon_mapping
