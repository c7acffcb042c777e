#include <algorithm>
#include <cmath>
#include <numeric>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/deep-screen-space/surfels/steps.h"
#include "renderers/methods/deep-screen-space/surfels/view.h"

namespace ir::methods::deep_screen_space {
namespace {

/// Every third bit of the result is one of the ten lowest of `value`.
std::uint32_t spread(std::uint32_t value) {
    std::uint32_t result = 0;
    for (int bit = 0; bit < 10; ++bit) result |= (value >> bit & 1u) << 3 * bit;
    return result;
}

/// Where the middle of a triangle lies on a Morton curve through the world.
std::uint32_t morton(const scene::World& world, std::size_t triangle) {
    const auto corner = [&](std::size_t i) { return world.positions[world.indices[3 * triangle + i]]; };
    const auto middle = (corner(0) + corner(1) + corner(2)) / 3.0f;
    const auto size = glm::max(world.bounds.max - world.bounds.min, glm::vec3(1e-30f));
    const float widest = std::max({size.x, size.y, size.z});
    const auto cell = glm::clamp((middle - world.bounds.min) / widest, 0.0f, 1.0f) * 1023.0f;
    const auto part = [&](int axis) {
        return std::isfinite(cell[axis]) ? spread(static_cast<std::uint32_t>(cell[axis])) << axis : 0u;
    };
    return part(0) | part(1) | part(2);
}

std::vector<std::uint32_t> order_of(const scene::World& world) {
    std::vector<std::uint32_t> keys(world.triangles()), order(world.triangles());
    for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = morton(world, i);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
    return order;
}

/// Constants of place.comp.
struct Place {
    Ideal ideal;
    unsigned seed, patch_capacity, capacity;
    IR_FIELDS(ideal, seed, patch_capacity, capacity)
};

}  // namespace

graph::BufferRef order_triangles(graph::GraphBuilder& builder) {
    const auto triangles = static_cast<std::uint64_t>(builder.inputs().world->triangles());
    const auto order = builder.buffer({.text = {.key = "surfels.order",
                                                .label = "Order of triangles",
                                                .doc = "By where they lie: along a curve through space."},
                                       .name = "Order",
                                       .fields = {{"triangle", graph::FieldType::u32}},
                                       .elements = std::max<std::uint64_t>(1, triangles),
                                       .fingerprint = builder.inputs().geometry_fingerprint});
    builder.pass("order triangles", graph::Queue::cpu)
        .writes(order)
        .execute([=](graph::PassContext& context) {
            const auto sorted = order_of(*context.inputs().world);
            std::ranges::copy(sorted, context.elements<std::uint32_t>(order).begin());
        });
    return order;
}

Surfels place(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const Patches& patches,
              std::uint64_t reserve, const Parameters& parameters, const std::string& fingerprint) {
    const auto kept = declare_records(builder, reserve, fingerprint);
    builder.pass("place surfels")
        .reads(scene.positions, scene.indices, scene.uv0, scene.uv1, scene.triangle_materials,
               scene.materials, scene.opacity, scene.opacity_words)
        .reads("Patches", patches.list.buffer)
        .reads("Points", patches.points.buffer)
        .writes("Surfels", kept.buffer)
        .counts("PatchCount", patches.list.count)
        .counts("WordCount", patches.points.count)
        .counts("UnitCount", patches.total)
        .counts("SurfelCount", kept.count)
        .execute_sliced(
            packing_parts,
            [=](graph::PassContext& context, graph::Slice slice) {
                const auto& program = context.use({{"methods/deep-screen-space/surfels/place.comp"}});
                const auto capacity = context.capacity(kept.buffer);
                const auto listed =
                    std::min(context.capacity(patches.list.buffer), context.capacity(patches.points.buffer));
                program.set(Place{ideal(context.inputs().view, parameters),
                                  random_seed(context.inputs(), parameters), static_cast<unsigned>(listed),
                                  static_cast<unsigned>(capacity)});
                dispatch_parts(program, capacity, slice);
            },
            1);
    return count_stored(builder, kept, fingerprint);
}

}  // namespace ir::methods::deep_screen_space
