#include "renderers/methods/ldm-ao/passes.h"

#include "renderers/graph/pass_context.h"
#include "renderers/passes/ldm/host/trace_on_host.h"
#include "renderers/passes/scene/stands_still.h"

namespace ir::methods::ldm_ao {
namespace {

namespace ldm = passes::ldm;

/// Directions of one dispatch: drivers may stop the loops of an invocation after 65,535 turns in all, and
/// each direction walks through a list.
constexpr std::int64_t directions_per_dispatch = 16;

/// Constants of trace.comp.
struct Trace {
    ldm::FrameConstants frames;
    ExactConstants exact;
    unsigned first_frame, first_map, map_count;
    IR_FIELDS(frames, exact, first_frame, first_map, map_count)
};

/// Constants of resolve.comp.
struct Resolve {
    bool continues;
    IR_FIELDS(continues)
};

void declare_trace(graph::GraphBuilder& builder, const std::string& name, const passes::GBuffer& gbuffer,
                   MapsPointer maps, int batch, graph::ImageRef sums, bool views, const ExactHits* exact) {
    auto pass = builder.pass(name + maps->batch_name(batch));
    ldm::reads_maps(pass, *maps);
    pass.reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal).writes("sums", sums);
    if (exact) pass.reads("ExactHits", exact->hits);
    const auto replaced = exact ? std::optional(exact_constants(*exact, *maps)) : std::nullopt;
    const auto run = [=](graph::PassContext& context, graph::Slice slice) {
        gl::ProgramSource source{{"methods/ldm-ao/trace.comp"}};
        source.defines = ldm::defines_of(context, *maps);
        if (views) source.defines["LDM_VIEWS"] = "1";
        if (replaced) source.defines["EXACT_HITS"] = "1";
        if (views && maps->options.storage == ldm::StorageKind::outermost)
            context.notes().warn(
                "storage=outermost: views of self-hits count own entries between the outermost two as missing");
        const auto& program = context.use(source);
        const auto shape = context.shape(sums);
        const auto end = std::min<std::int64_t>(slice.end * directions_per_dispatch, maps->batch_maps(batch));
        for (auto first = slice.begin * directions_per_dispatch; first < end;
             first += directions_per_dispatch) {
            const auto count = std::min(directions_per_dispatch, end - first);
            const auto frame = maps->first_map(batch) + first;
            program.set(Trace{.frames = ldm::frame_constants(*maps, frame, count),
                              .exact = replaced.value_or(ExactConstants{}),
                              .first_frame = static_cast<unsigned>(frame),
                              .first_map = static_cast<unsigned>(first),
                              .map_count = static_cast<unsigned>(count)});
            program.dispatch(shape.width, shape.height);
            context.barrier();
        }
    };
    const auto dispatches = (maps->batch_maps(batch) + directions_per_dispatch - 1) / directions_per_dispatch;
    pass.execute_sliced(dispatches, run, 1);
}

}  // namespace

OutputDescription overlay_output() {
    return {.key = "ldm.self_hit_overlay",
            .label = "Self-hits in colour",
            .semantic = Semantic::albedo,
            .doc =
                "Accessibility with colours for what the self-hit rule did. Grey: the point's own entry was "
                "found in all directions. Blue: it was missing in some, because its surface ends before "
                "the texel's centre. Orange-red: another's may have been taken for it, where light may "
                "leak. Colours grow with the fraction of the directions, and are full from one half on."};
}

ldm::Visibility visibility_of(const Transport& transport) {
    return {.max_distance = transport.max_distance,
            .smooth = transport.falloff == Transport::Falloff::smooth};
}

bool has_host_body(const Parameters& parameters) {
    return !replaces_hits(parameters.exact) && ldm::has_host_body(parameters.maps);
}

void trace_on_host(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const MapsPointer& maps,
                   const Images& images, const ldm::Sky* sky, const Parameters& parameters) {
    const auto meshlets = ldm::declare_meshlets(builder, maps->options.detail);
    const auto rule = ldm::self_hit_rule(parameters.maps, maps->layout.nodes);
    ldm::trace_on_host(builder, gbuffer, meshlets, maps, rule, visibility_of(parameters.transport),
                       !parameters.progressive, images.sums);
    if (sky) ldm::trace_sky_on_host(builder, gbuffer, meshlets, maps, *sky, rule);
    ldm::count_self_hits_on_host(builder, gbuffer, meshlets, maps, rule, images.view_counts);
}

Images declare_images(graph::GraphBuilder& builder, const Parameters& parameters) {
    Images images;
    images.sums =
        builder.image({.text = {.key = "ldm.sums",
                                .label = "Sums over directions",
                                .doc = "Σ V cosθ and Σ cosθ over the directions above the surface."},
                       .format = gl::Format::rg32f});
    if (parameters.progressive)
        images.average = builder.image({.text = {.key = "ldm.average",
                                                 .label = "Mean over frames",
                                                 .doc = "Mean accessibility and number of frames.",
                                                 .semantic = Semantic::accessibility},
                                        .format = gl::Format::rg32f});
    images.accessibility = builder.output("accessibility", {.format = gl::Format::r32f});
    images.view_counts = builder.image(
        {.text = {.key = "ldm.self_hit_counts",
                  .label = "Counts of self-hits",
                  .doc = "Directions in which the own entry was found; that were queried; in which it was "
                         "missing; in which another's may have been taken for it.",
                  .semantic = Semantic::count},
         .format = gl::Format::rgba32f});
    images.self_hits = builder.output("ldm.self_hits", {.format = gl::Format::r32f});
    images.missing = builder.output("ldm.missing", {.format = gl::Format::r32f});
    images.leaks = builder.output("ldm.leaks", {.format = gl::Format::r32f});
    images.self_hit_overlay = builder.output("ldm.self_hit_overlay", {.format = gl::Format::rgba16f});
    return images;
}

void trace(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, MapsPointer maps, int batch,
           const Images& images, const ExactHits* exact) {
    declare_trace(builder, "trace", gbuffer, std::move(maps), batch, images.sums, false, exact);
}

void trace_views(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, MapsPointer maps, int batch,
                 const Images& images) {
    declare_trace(builder, "trace self-hits", gbuffer, std::move(maps), batch, images.view_counts, true,
                  nullptr);
}

void resolve(graph::GraphBuilder& builder, const Images& images, const Parameters& parameters) {
    auto pass = builder.pass("accessibility");
    pass.reads("sums", images.sums).writes("accessibility", images.accessibility);
    if (parameters.progressive)
        pass.writes("average", images.average).reads_previous("previous", images.average);
    gl::ProgramSource source{{"methods/ldm-ao/resolve.comp"}};
    if (parameters.progressive) source.defines["PROGRESSIVE"] = "1";
    pass.compute(source, images.accessibility, [](const graph::PassContext& context) {
        return Resolve{context.has_previous() &&
                       passes::stands_still(context.inputs(), passes::Watched::surfaces)};
    });
}

void resolve_views(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Images& images) {
    builder.pass("self-hit views")
        .reads("counts", images.view_counts)
        .writes("found", images.self_hits)
        .writes("missing", images.missing)
        .writes("suspect", images.leaks)
        .compute({{"methods/ldm-ao/self_hit_views.comp"}}, images.self_hits);
    builder.pass("self-hit overlay")
        .reads("accessibility", images.accessibility)
        .reads("counts", images.view_counts)
        .reads(gbuffer.geometric_normal)
        .writes("overlay", images.self_hit_overlay)
        .compute({{"methods/ldm-ao/self_hit_overlay.comp"}}, images.self_hit_overlay);
}

}  // namespace ir::methods::ldm_ao
