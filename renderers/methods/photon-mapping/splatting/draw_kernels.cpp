#include "renderers/methods/photon-mapping/splatting/stages.h"

#include "renderers/graph/pass_context.h"
#include "renderers/methods/photon-mapping/splatting/splat_view.h"

namespace ir::methods::photon_mapping {
namespace {

using graph::FieldType;

bool is_flat(const Kernels& kernels) {
    return kernels.parameters.inside_test == InsideTest::linear_depth;
}

constexpr unsigned corners_of_square = 4, corners_of_icosahedron = 60;

/// As OpenGL reads it.
struct DrawCommand {
    std::uint32_t vertices, instances, first_vertex, base_vertex, base_instance;
    IR_FIELDS(vertices, instances, first_vertex, base_vertex, base_instance)
};

graph::BufferRef declare_command(graph::GraphBuilder& builder, const std::string& key) {
    return builder.buffer({.text = {.key = key,
                                    .label = "Command of the draw",
                                    .doc = "Vertices and instances of the last slice drawn."},
                           .fields = record_fields<DrawCommand>(),
                           .elements = 1});
}

/// Constants of draw.comp.
struct WriteCommand {
    unsigned first, end, vertices_of_kernel;
    IR_FIELDS(first, end, vertices_of_kernel)
};

void write_command(const graph::PassContext& p, const Kernels& kernels, passes::PhotonRange range) {
    const auto& program = p.use({{"methods/photon-mapping/splatting/draw.comp"}});
    program.set(WriteCommand{static_cast<unsigned>(range.first), static_cast<unsigned>(range.end),
                             is_flat(kernels) ? corners_of_square : corners_of_icosahedron});
    program.dispatch(1);
    p.barrier();
}

void bind_targets(const graph::PassContext& p, const Kernels& kernels, const KernelPass& pass) {
    std::vector<graph::PassContext::Attachment> colours;
    for (const auto target : pass.targets) colours.push_back({target});
    const graph::PassContext::Attachment stencil{kernels.surfaces.stencil};
    p.bind_framebuffer(colours, pass.depth_test ? &stencil : nullptr);
}

/// Sums, in the order of the buffer; larger depths are closer. The offset keeps rounded corners of an
/// icosahedron from falling behind the surface that it encloses.
void set_state(const gl::Api& gl, const Kernels& kernels, const KernelPass& pass) {
    gl.Enable(GL_BLEND);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.BlendFunc(GL_ONE, GL_ONE);
    gl.Enable(GL_DEPTH_CLAMP);
    if (!is_flat(kernels)) gl.Enable(GL_CULL_FACE);
    if (!pass.depth_test) return;
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_GREATER);
    gl.DepthMask(GL_FALSE);
    gl.Enable(GL_POLYGON_OFFSET_FILL);
    gl.PolygonOffset(0.05f, 8);
}

void draw(const graph::PassContext& p, const Kernels& kernels, graph::BufferRef command) {
    const auto& gl = p.api();
    p.bind_empty_vertex_array();
    gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, p.buffer(command));
    if (is_flat(kernels)) {
        gl.DrawArraysIndirect(GL_TRIANGLE_STRIP, nullptr);
    } else {
        gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, p.buffer(kernels.corners));
        gl.DrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr);
        gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);  // part of the vertex array, which others use
    }
    gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
}

/// Constants of splat.vert and splat.frag.
struct SplatPhotons {
    KernelRules rules;
    unsigned first;
    IR_FIELDS(rules, first)
};

void run(const graph::PassContext& p, graph::Slice slice, const Kernels& kernels, const KernelPass& pass,
         graph::BufferRef command) {
    if (slice.first)
        for (const auto target : pass.targets) p.clear(target);
    const auto range = passes::photons_of(p, kernels.photons, slice);
    if (range.first == range.end) return;
    write_command(p, kernels, range);
    bind_targets(p, kernels, pass);
    gl::ProgramSource source{
        {"methods/photon-mapping/splatting/splat.vert", "methods/photon-mapping/splatting/splat.frag"}};
    source.defines = kernel_defines(kernels);
    source.defines.insert(pass.defines.begin(), pass.defines.end());
    const auto& program = p.use(source);
    program.set(SplatPhotons{kernel_rules(p.inputs(), kernels.parameters, kernels.photons.power_unit),
                             static_cast<unsigned>(range.first)});
    set_state(p.api(), kernels, pass);
    draw(p, kernels, command);
    p.api().Disable(GL_BLEND);
}

}  // namespace

Kernels declare_kernels(graph::GraphBuilder& builder, const StoredPhotons& photons, graph::ImageRef tiles,
                        const SplatSurfaces& surfaces, const Parameters& parameters) {
    Kernels kernels{photons, tiles, surfaces, {}, {}, parameters};
    const auto solid = icosahedron();
    kernels.vertices = builder.buffer({.text = {.key = "splat.icosahedron.vertices",
                                                .label = "Vertices of the icosahedron",
                                                .doc = "On the unit sphere."},
                                       .kind = OutputKind::point_set,
                                       .fields = {{"place", FieldType::f32, 3}},
                                       .elements = solid.vertices.size(),
                                       .fingerprint = "1"});
    kernels.corners = builder.buffer({.text = {.key = "splat.icosahedron.corners",
                                               .label = "Faces of the icosahedron",
                                               .doc = "Three vertices each."},
                                      .fields = {{"vertex", FieldType::u32}},
                                      .elements = solid.corners.size(),
                                      .fingerprint = "1"});
    builder.pass("upload icosahedron")
        .writes(kernels.vertices, kernels.corners)
        .execute([=](graph::PassContext& p) {
            p.upload(kernels.vertices, std::as_bytes(std::span(solid.vertices)));
            p.upload(kernels.corners, std::as_bytes(std::span(solid.corners)));
        });
    return kernels;
}

std::map<std::string, std::string> kernel_defines(const Kernels& kernels) {
    std::map<std::string, std::string> defines;
    if (is_flat(kernels)) defines["LINEAR_DEPTH"] = "1";
    if (kernels.parameters.facing_test) defines["FACING"] = "1";
    if (kernels.parameters.edge_probes) defines["EDGE_PROBES"] = "1";
    return defines;
}

void draw_kernels(graph::GraphBuilder& builder, const Kernels& kernels, const KernelPass& pass) {
    const auto command = declare_command(builder, pass.command_key);
    auto declared = builder.pass(pass.name);
    if (pass.has_two_bodies) declared.has_two_bodies();
    declared.reads("Photons", kernels.photons.records)
        .reads("Stored", kernels.photons.stored)
        .reads("tiles", kernels.tiles)
        .reads("Icosahedron", kernels.vertices)
        .reads(kernels.corners)
        .reads("depths", kernels.surfaces.depth)
        .writes("Draw", command);
    if (kernels.parameters.facing_test) declared.reads(kernels.surfaces.gbuffer.geometric_normal);
    for (const auto target : pass.targets) declared.writes(target);
    if (pass.depth_test) declared.writes(kernels.surfaces.stencil);
    declared.execute_sliced(passes::photon_parts, [=](graph::PassContext& p, graph::Slice slice) {
        run(p, slice, kernels, pass, command);
    });
}

}  // namespace ir::methods::photon_mapping
