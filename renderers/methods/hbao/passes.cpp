#include "renderers/methods/hbao/passes.h"

#include <algorithm>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/hbao/host/march_on_host.h"

namespace ir::methods::hbao {
namespace {

/// Drivers may stop the loops of an invocation after 65,535 turns in all.
constexpr int steps_per_dispatch = 8192;

/// Constants of march.comp.
struct March {
    MarchConstants march;
    int first_direction, end_direction;
    IR_FIELDS(march, first_direction, end_direction)
};

void march_directions(graph::PassContext& context, graph::ImageRef sums, int first, int end) {
    const auto& program = context.use({{"methods/hbao/march.comp"}});
    program.set(March{march_constants(context.inputs().view), first, end});
    const auto shape = context.shape(sums);
    program.dispatch(shape.width, shape.height);
    context.barrier();
}

void march_on_device(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                     const Parameters& parameters, graph::ImageRef sums) {
    const int at_once = std::max(1, steps_per_dispatch / parameters.steps), all = parameters.directions;
    builder.pass("march")
        .has_two_bodies()
        .reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal)
        .writes("sums", sums)
        .execute_sliced((all + at_once - 1) / at_once,
                        [=](graph::PassContext& context, graph::Slice slice) {
                            for (auto i = static_cast<int>(slice.begin); i < static_cast<int>(slice.end); ++i)
                                march_directions(context, sums, i * at_once,
                                                 std::min(all, (i + 1) * at_once));
                        },
                        1);
}

void resolve(graph::GraphBuilder& builder, const Marched& marched) {
    builder.pass("resolve")
        .reads("sums", marched.sums)
        .writes("raw", marched.raw)
        .writes("cut", marched.cut)
        .compute({{"methods/hbao/resolve.comp"}}, marched.raw);
}

}  // namespace

std::vector<OutputDescription> marched_outputs() {
    return {
        {.key = "hbao.raw",
         .label = "Before the blur",
         .semantic = Semantic::accessibility,
         .doc = "Accessibility of each pixel's own directions."},
        {.key = "hbao.cut",
         .label = "Cut off by the picture's edge",
         .semantic = Semantic::probability,
         .doc =
             "Fraction of the directions whose march ended at the edge of the picture before the radius did: "
             "what lies beyond occludes nothing."},
    };
}

Marched march(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Parameters& parameters) {
    Marched marched;
    marched.sums = builder.image(
        {.text = {.key = "hbao.sums",
                  .label = "Sums over directions",
                  .doc = "Weight that is open; all weight; directions cut off by the picture's edge; "
                         "samples that were looked at."},
         .format = gl::Format::rgba32f});
    marched.raw = builder.output("hbao.raw", {.format = gl::Format::r32f});
    marched.cut = builder.output("hbao.cut", {.format = gl::Format::r32f});
    if (builder.inputs().processor == Processor::host)
        march_on_host(builder, gbuffer, parameters, marched.sums);
    else
        march_on_device(builder, gbuffer, parameters, marched.sums);
    resolve(builder, marched);
    return marched;
}

MarchConstants march_constants(const scene::View& view) {
    return {passes::pixel_rays(view), passes::pixel_from_world(view)};
}

}  // namespace ir::methods::hbao
