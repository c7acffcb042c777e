#include "renderers/methods/deep-screen-space/splatting/level0_light.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "renderers/core/threads.h"

namespace ir::methods::deep_screen_space {

glm::vec2 weights_at(const scene::World& world, std::uint32_t triangle, const glm::vec3& position_ws) {
    const auto corner = [&](std::size_t i) { return world.positions[world.indices[3 * triangle + i]]; };
    const auto a = corner(0), ab = corner(1) - a, ac = corner(2) - a, ap = position_ws - a;
    const auto n = glm::cross(ab, ac);
    const float area = glm::dot(n, n);
    if (area == 0) return glm::vec2(0);
    return glm::clamp(glm::vec2(glm::dot(glm::cross(ap, ac), n), glm::dot(glm::cross(ab, ap), n)) / area,
                      0.0f, 1.0f);
}

void light_level0(graph::GraphBuilder& builder, const VisibleSplats& visible, const std::string& batch) {
    const auto& parameters = visible.splats.parameters;
    const auto irradiance = visible.irradiance, distance = visible.samples.distance;
    const auto first_sample = static_cast<std::size_t>(visible.splats.first_sample);
    const auto bvh = passes::bvh(builder);
    const auto sources = sources_of(builder, parameters);
    const auto directions = visible.directions.directions;
    builder.pass("light samples of level 0" + batch, graph::Queue::cpu)
        .reads(bvh, sources, visible.gbuffer.position, visible.nearest, distance, directions)
        .writes(irradiance)
        .execute_sliced(
            visible.splats.samples,
            [=, nearest = visible.nearest, position = visible.gbuffer.position](graph::PassContext& context,
                                                                                graph::Slice slice) {
                const auto& inputs = context.inputs();
                const Level0Light light(context, bvh, sources, parameters);
                const auto from = context.pixels<const glm::vec4>(position);
                tbb::task_arena arena(arena_size(inputs.threads));
                for (auto layer = static_cast<int>(slice.begin); layer < slice.end; ++layer) {
                    const auto winners = context.pixels<const std::uint32_t>(nearest, layer);
                    const auto distances = context.pixels<const float>(distance, layer);
                    const auto towards = context.pixels<const glm::vec4>(directions, layer);
                    const auto result = context.pixels<glm::vec4>(irradiance, layer);
                    const auto light_of = [&](std::size_t i) {
                        if (!(winners[i] & exact_hit)) return glm::vec4(0);
                        const auto triangle = winners[i] & ~exact_hit;
                        const glm::vec3 direction(towards[i]);
                        const auto weights = weights_at(*inputs.world, triangle,
                                                        glm::vec3(from[i]) + distances[i] * direction);
                        const auto ray =
                            winners.size() * (first_sample + static_cast<std::size_t>(layer)) + i;
                        return glm::vec4(light.irradiance(triangle, weights, direction, ray), 1);
                    };
                    arena.execute([&] {
                        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, winners.size()),
                                          [&](const auto& range) {
                                              for (auto i = range.begin(); i != range.end(); ++i)
                                                  result[i] = light_of(i);
                                          });
                    });
                    context.cancel().check();
                }
            },
            1);
}

}  // namespace ir::methods::deep_screen_space
