#include "renderers/passes/rsm/rsm.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "renderers/passes/rsm/rsm_on_host.h"
#include "renderers/passes/scene/draw_triangles.h"
#include "renderers/passes/shadow/texel_constants.h"

namespace ir::passes {
namespace {

using graph::PassContext;
using graph::Slice;

struct Drawing {
    SceneBuffers scene;
    Rsm rsm;
    RsmOptions options;
    std::shared_ptr<TriangleChunks> chunks = std::make_shared<TriangleChunks>();  ///< of the frame's world
};

graph::ImageRef declare(graph::GraphBuilder& builder, const Rsm& rsm, const std::string& name,
                        graph::ResourceText text, gl::Format format) {
    graph::ImageDesc desc;
    desc.name = name;
    desc.text = std::move(text);
    desc.format = format;
    desc.extent = graph::Extent::fixed(rsm.resolution, rsm.resolution);
    desc.layers = rsm.layers;
    desc.fingerprint = rsm.fingerprint;
    return builder.image(std::move(desc));
}

/// Constants of triangles.vert and depth.frag.
struct DrawDepth {
    TexelConstants texel;
    LightCone cone;
    IR_FIELDS(texel, cone)
};
DrawDepth depth_constants(const PassContext& p, const ShadowViewData& view, int resolution) {
    return {texel_constants(view, resolution), light_cone(*p.inputs().world, view)};
}

/// Constants of triangles.vert and rsm.frag.
struct DrawSurfaces {
    DrawDepth depth;
    bool normal_maps, opaque_only;
    int textures, layer;
    IR_FIELDS(depth, normal_maps, opaque_only, textures, layer)
};

void draw_depth(const PassContext& p, const Drawing& d, graph::ImageRef target, Slice slice) {
    if (slice.first) *d.chunks = TriangleChunks(*p.inputs().world);
    p.bind_empty_vertex_array();
    p.api().Enable(GL_DEPTH_TEST);
    for (auto layer = slice.begin; layer < slice.end; ++layer) {
        const PassContext::Attachment depth{target, static_cast<int>(layer)};
        p.bind_framebuffer({}, &depth);
        const float far = 1;
        p.api().ClearBufferfv(GL_DEPTH, 0, &far);
        if (static_cast<std::size_t>(layer) >= d.options.views.size()) continue;
        const auto& program = p.use({{"passes/scene/triangles.vert", "passes/rsm/depth.frag"}});
        auto constants =
            depth_constants(p, d.options.views[static_cast<std::size_t>(layer)], d.rsm.resolution);
        for (const auto& range : p.inputs().world->ranges) {
            const auto runs =
                d.chunks->seen(constants.texel.clip_from_world, {range.first_triangle, range.triangle_count});
            if (runs.empty()) continue;
            constants.texel.material_index = range.material;
            program.set(constants);
            draw_triangles(p, runs);
        }
    }
    p.api().Disable(GL_DEPTH_TEST);
}

void draw_surfaces(const PassContext& p, const Drawing& d, Slice slice) {
    if (slice.first) {
        p.upload(d.rsm.views, std::as_bytes(std::span(d.options.views)));
        *d.chunks = TriangleChunks(*p.inputs().world);
    }
    p.bind_empty_vertex_array();
    p.api().Enable(GL_DEPTH_TEST);
    for (auto layer = slice.begin; layer < slice.end; ++layer) {
        const int index = static_cast<int>(layer);
        const PassContext::Attachment depth{d.rsm.depth, index};
        std::vector<PassContext::Attachment> colours{{d.rsm.albedo_roughness, index},
                                                     {d.rsm.normal_metalness, index}};
        if (d.options.geometric_normal) colours.push_back({d.rsm.geometric_normal, index});
        p.bind_framebuffer(colours, &depth);
        const float zero[4] = {0, 0, 0, 0}, far = 1;
        for (int i = 0; i < static_cast<int>(colours.size()); ++i) p.api().ClearBufferfv(GL_COLOR, i, zero);
        p.api().ClearBufferfv(GL_DEPTH, 0, &far);
        if (static_cast<std::size_t>(layer) >= d.options.views.size()) continue;
        gl::ProgramSource source{{"passes/scene/triangles.vert", "passes/rsm/rsm.frag"}};
        if (d.options.depth_prepass) source.defines["DEPTH_PREPASS"] = "1";
        if (d.options.geometric_normal) source.defines["GEOMETRIC_NORMAL"] = "1";
        const auto& program = p.use(source);
        DrawSurfaces constants{
            .depth = depth_constants(p, d.options.views[static_cast<std::size_t>(layer)], d.rsm.resolution),
            .normal_maps = d.options.normal_maps,
            .opaque_only = d.options.opaque_only,
            .textures = 0,
            .layer = index};
        for (const auto& range : p.inputs().world->ranges) {
            const auto runs = d.chunks->seen(constants.depth.texel.clip_from_world,
                                             {range.first_triangle, range.triangle_count});
            if (runs.empty()) continue;
            const auto& material = p.inputs().scene->materials.at(static_cast<std::size_t>(range.material));
            constants.depth.texel.material_index = range.material;
            constants.textures = bind_textures(p, d.scene, material);
            program.set(constants);
            draw_triangles(p, runs);
        }
    }
    p.api().Disable(GL_DEPTH_TEST);
}

/// The option's own depth, so that the RSM's can be tested against it while it is written.
graph::ImageRef draw_depth_first(graph::GraphBuilder& builder, const Drawing& drawing) {
    const auto target = declare(builder, drawing.rsm, "depth_drawn_first",
                                {.key = "rsm.depth_prepass",
                                 .label = "RSM: depth drawn first",
                                 .doc = "The shadow map at the RSM's resolution; what lies behind it is not "
                                        "shaded.",
                                 .semantic = Semantic::depth},
                                gl::Format::depth32f);
    auto pass = builder.pass("RSM depth");
    reads_triangles(pass, drawing.scene);
    pass.writes(target).execute_sliced(
        drawing.rsm.layers, [=](PassContext& p, Slice slice) { draw_depth(p, drawing, target, slice); }, 1);
    return target;
}

}  // namespace

LightCone light_cone(const scene::World& world, const ShadowViewData& view) {
    const auto& light = world.lights.at(static_cast<std::size_t>(view.light));
    if (light.type != scene::LightType::spot) return {};
    return {light.direction, std::cos(light.outer_angle)};
}

Rsm draw_rsm(graph::GraphBuilder& builder, const SceneBuffers& scene, const RsmOptions& options) {
    Rsm rsm;
    rsm.resolution = options.resolution;
    rsm.views_drawn = static_cast<int>(options.views.size());
    rsm.layers = std::max(1, rsm.views_drawn);
    const bool has_two_bodies = options.may_be_traced && rsm.resolution % 4 == 0;
    const bool is_traced = has_two_bodies && builder.inputs().processor == Processor::host;
    const auto& world = builder.inputs().world_fingerprint;
    if (!world.empty() && !options.views_differ)
        rsm.fingerprint = world + " at " + std::to_string(rsm.resolution) +
                          (options.opaque_only ? " opaque" : "") + (options.normal_maps ? " mapped" : "") +
                          (is_traced ? " traced" : "");
    const auto text = [&](const char* key) { return builder.text_of_output(key); };
    rsm.albedo_roughness = declare(builder, rsm, "rsm_albedo_roughness", text("rsm.albedo_roughness"),
                                   options.exact_albedo ? gl::Format::rgba16f : gl::Format::rgba8);
    rsm.normal_metalness =
        declare(builder, rsm, "rsm_normal_metalness", text("rsm.normal_metalness"), gl::Format::rgba16f);
    if (options.geometric_normal)
        rsm.geometric_normal =
            declare(builder, rsm, "rsm_geometric_normal", text("rsm.geometric_normal"), gl::Format::rgba32f);
    rsm.depth = declare(builder, rsm, "shadow_maps", text("rsm.depth"), gl::Format::depth32f);
    graph::BufferDesc views;
    views.text = {"rsm.views", "Views of the RSM"};
    views.name = "ShadowViews";
    views.fields = record_fields<ShadowViewData>();
    views.elements = static_cast<std::uint64_t>(rsm.layers);
    views.fingerprint = rsm.fingerprint;
    rsm.views = builder.buffer(views);

    if (is_traced) {  // rays shade nothing that is hidden: they need no prepass
        rsm_on_host(builder, rsm, options);
        return rsm;
    }
    const Drawing drawing{scene, rsm, options};
    graph::ImageRef prepass;
    if (options.depth_prepass) prepass = draw_depth_first(builder, drawing);
    auto pass = builder.pass("RSM");
    if (has_two_bodies) pass.has_two_bodies();
    reads_triangles(pass, scene);
    reads_textures(pass, scene);
    if (options.depth_prepass) pass.reads(prepass);
    if (options.geometric_normal) pass.writes(rsm.geometric_normal);
    pass.writes(rsm.albedo_roughness, rsm.normal_metalness, rsm.depth, rsm.views)
        .execute_sliced(
            rsm.layers, [=](PassContext& p, Slice slice) { draw_surfaces(p, drawing, slice); }, 1);
    return rsm;
}

void reads_rsm(graph::PassBuilder& pass, const Rsm& rsm, const SceneBuffers& scene) {
    pass.reads(rsm.views, scene.lights, rsm.albedo_roughness, rsm.normal_metalness, rsm.depth);
}

std::vector<OutputDescription> rsm_outputs(const Condition& active_when, bool geometric_normal) {
    const std::string layers = " One layer per spot or directional light, six per point light.";
    std::vector<OutputDescription> outputs{
        {.key = "rsm.albedo_roughness",
         .label = "RSM: base colour",
         .kind = OutputKind::stack,
         .semantic = Semantic::albedo,
         .doc = "What the light sees: linear base colour; a: roughness. 0 where there is nothing, or where a "
                "spot does not shine." +
                layers,
         .active_when = active_when},
        {.key = "rsm.normal_metalness",
         .label = "RSM: normal",
         .kind = OutputKind::stack,
         .semantic = Semantic::normal,
         .doc = "Shading normal in world space, on the light's side; a: 1 + metalness, negative where "
                "nothing is scattered (glass, unlit surfaces), 0 where there is nothing." +
                layers,
         .active_when = active_when},
        {.key = "rsm.depth",
         .label = "RSM: depth",
         .kind = OutputKind::stack,
         .semantic = Semantic::depth,
         .doc = "Depth along the map's axis over its far distance." + layers,
         .active_when = active_when}};
    if (geometric_normal)
        outputs.push_back(
            {.key = "rsm.geometric_normal",
             .label = "RSM: geometric normal",
             .kind = OutputKind::stack,
             .semantic = Semantic::normal,
             .doc = "Normal of the triangle's plane in world space, on the light's side; 0 where "
                    "there is nothing. A: the part that is no glass; of what is all opaque 2 + its index of "
                    "refraction." +
                    layers,
             .active_when = active_when});
    return outputs;
}

}  // namespace ir::passes
