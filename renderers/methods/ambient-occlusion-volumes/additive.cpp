#include "renderers/methods/ambient-occlusion-volumes/volumes.h"

namespace ir::methods::ambient_occlusion_volumes {
namespace {

graph::ImageRef declare(graph::GraphBuilder& builder, const std::string& key) {
    return builder.output(key, {.format = gl::Format::r32f});
}

/// Sums what the fragments give, over all triangles in their order.
void blend(const graph::PassContext& context, const Volumes& volumes, const gl::ProgramSource& source,
           const std::vector<graph::ImageRef>& targets, graph::Slice slice) {
    if (slice.first)
        for (const auto target : targets) context.clear(target);
    std::vector<graph::PassContext::Attachment> colours;
    for (const auto target : targets) colours.push_back({target});
    context.bind_framebuffer(colours);
    context.use(source).set(hull(context.inputs(), volumes));
    const auto& gl = context.api();
    gl.Enable(GL_BLEND);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.BlendFunc(GL_ONE, GL_ONE);
    draw_volumes(context, slice.begin, slice.end);
    gl.Disable(GL_BLEND);
}

}  // namespace

graph::ImageRef add_up(graph::GraphBuilder& builder, const Volumes& volumes, Transport::Falloff falloff) {
    const auto sum = declare(builder, "volumes.sum"), raw = declare(builder, "volumes.raw");
    if (builder.inputs().processor == Processor::host) {
        add_up_on_host(builder, volumes, falloff, sum);
    } else {
        auto pass = builder.pass("additive");
        read_volumes(pass, volumes);
        pass.has_two_bodies().writes(sum).execute_sliced(
            volumes.triangles, [volumes, sum](graph::PassContext& context, graph::Slice slice) {
                blend(context, volumes, drawing_with("additive.frag"), {sum}, slice);
            });
    }
    builder.pass("compensate")
        .reads("sums", sum)
        .writes("raw", raw)
        .compute({{"methods/ambient-occlusion-volumes/compose.comp"}}, raw);
    return raw;
}

void count_volumes(graph::GraphBuilder& builder, const Volumes& volumes) {
    const auto covering = declare(builder, "volumes.covering"), within = declare(builder, "volumes.within");
    auto pass = builder.pass("count volumes");
    read_volumes(pass, volumes);
    pass.writes(covering, within)
        .execute_sliced(volumes.triangles, [=](graph::PassContext& context, graph::Slice slice) {
            blend(context, volumes, drawing_with("count.frag"), {covering, within}, slice);
        });
}

std::vector<OutputDescription> additive_outputs() {
    const Condition additive{"visibility", {false}};
    return {
        {.key = "volumes.sum",
         .label = "Sum of occlusion",
         .doc = "Form factors of all triangles whose volumes the pixel's point lies in, with their fall-off "
                "and the mean of their masks. Above 1 where what lies behind each other was counted more "
                "than once.",
         .active_when = additive},
        {.key = "volumes.raw",
         .label = "Before the blur",
         .semantic = Semantic::accessibility,
         .doc = "Accessibility that is made of the sum.",
         .active_when = additive},
    };
}

std::vector<OutputDescription> count_outputs() {
    return {
        {.key = "volumes.covering",
         .label = "Volumes drawn",
         .semantic = Semantic::count,
         .doc = "How many volumes cover the pixel: each costs the work of a fragment, with visibility for "
                "each sample."},
        {.key = "volumes.within",
         .label = "Volumes entered",
         .semantic = Semantic::count,
         .doc = "In how many volumes the pixel's point lies: only their triangles may occlude it."},
    };
}

}  // namespace ir::methods::ambient_occlusion_volumes
