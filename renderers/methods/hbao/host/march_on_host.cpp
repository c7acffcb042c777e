#include "renderers/methods/hbao/host/march_on_host.h"

#include <memory>

#include "renderers/core/half_float.h"
#include "renderers/core/parallel_for.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/hbao/host/march_pixels.h"

namespace ir::methods::hbao {
namespace {

std::shared_ptr<MarchedSurfaces> surfaces_of(const graph::PassContext& context,
                                             const passes::GBuffer& gbuffer) {
    const auto& view = context.inputs().view;
    const auto positions = context.pixels<const glm::vec4>(gbuffer.position),
               geometric_normals = context.pixels<const glm::vec4>(gbuffer.geometric_normal);
    const auto normals = context.pixels<const std::uint64_t>(gbuffer.normal);
    const auto made = std::make_shared<MarchedSurfaces>(view.width, view.height);
    const auto width = static_cast<std::size_t>(view.width);
    parallel_for(context.inputs().threads, 0, view.height, [&](std::int64_t y) {
        for (auto i = static_cast<std::size_t>(y) * width; i < static_cast<std::size_t>(y + 1) * width; ++i)
            made->set(i, positions[i], glm::vec3(unpack_halves(normals[i])), glm::vec3(geometric_normals[i]));
    });
    return made;
}

}  // namespace

void march_on_host(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Parameters& parameters,
                   graph::ImageRef sums) {
    const auto& view = builder.inputs().view;
    const MarchRules rules{march_constants(view), parameters, view.width, view.height};
    const auto surfaces = builder.object(
        {.text = {.key = "hbao.surfaces", .label = "Surfaces by planes", .doc = "What is marched through."}});
    builder.pass("march", graph::Queue::cpu)
        .has_two_bodies()
        .reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal)
        .writes(sums, surfaces)
        .execute_sliced(view.height, [=](graph::PassContext& context, graph::Slice slice) {
            if (slice.first) {
                const auto made = surfaces_of(context, gbuffer);
                context.store(surfaces, made, 9 * made->position[0].size() * sizeof(float));
            }
            const auto planes = context.object<MarchedSurfaces>(surfaces);
            const auto out = context.pixels<glm::vec4>(sums);
            const auto width = static_cast<std::size_t>(rules.width);
            parallel_for(context.inputs().threads, slice.begin, slice.end, [&](std::int64_t y) {
                march_row(rules, *planes, static_cast<int>(y),
                          out.subspan(static_cast<std::size_t>(y) * width, width));
            });
        });
}

}  // namespace ir::methods::hbao
