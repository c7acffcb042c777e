#include <algorithm>

#include "renderers/core/parallel_for.h"
#include "renderers/graph/image_layers.h"
#include "renderers/methods/ambient-occlusion-volumes/volumes.h"
#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/raytracing/ray_offset.h"

namespace ir::methods::ambient_occlusion_volumes {

void find_nearest_on_host(graph::GraphBuilder& builder, const Volumes& volumes,
                          const passes::bounce::Directions& directions, const Bounced& bounced) {
    const auto bvh = passes::bvh(builder);
    const auto& gbuffer = volumes.gbuffer;
    const auto& view = builder.inputs().view;
    constexpr std::int64_t block = 256;  // pixels that a thread does at a time
    const auto blocks = (std::int64_t{view.width} * view.height + block - 1) / block;
    builder.pass("bounced z", graph::Queue::cpu)
        .has_two_bodies()
        .reads(bvh, gbuffer.position, gbuffer.geometric_normal, directions.directions)
        .writes(bounced.distance, bounced.winner, bounced.depth)
        .execute_sliced(blocks * directions.samples, [=, reach = volumes.reach](graph::PassContext& context,
                                                                                graph::Slice slice) {
            const auto tree = context.object<passes::Bvh>(bvh);
            const auto positions = context.pixels<const glm::vec4>(gbuffer.position),
                       normals = context.pixels<const glm::vec4>(gbuffer.geometric_normal);
            const auto rays = graph::layers<const glm::vec4>(context, directions.directions);
            const auto distances = graph::layers<float>(context, bounced.distance),
                       depths = graph::layers<float>(context, bounced.depth);
            const auto winners = graph::layers<std::uint32_t>(context, bounced.winner);
            const auto trace = [&](std::size_t layer, std::size_t i) {
                const auto& ray = rays[layer][i];
                passes::Hit hit;
                if (ray.w != 0)
                    hit = tree->closest_hit(passes::offset_origin(positions[i], normals[i]), ray, 0, reach);
                winners[layer][i] = hit.is_hit() ? hit.triangle + 1 : 0;
                distances[layer][i] = hit.is_hit() ? hit.distance : -1;
                depths[layer][i] = hit.is_hit() ? hit.distance * hit.distance / (reach * reach) : 1;
            };
            parallel_for(context.inputs().threads, slice.begin, slice.end, [&](std::int64_t item) {
                const auto layer = static_cast<std::size_t>(item / blocks);
                const auto first = static_cast<std::size_t>(item % blocks * block);
                for (auto i = first; i < std::min(positions.size(), first + block); ++i) trace(layer, i);
            });
        });
}

}  // namespace ir::methods::ambient_occlusion_volumes
