#include "renderers/passes/raytracing/device_bvh.h"

#include "renderers/core/record.h"
#include "renderers/graph/declared.h"
#include "renderers/graph/pass_context.h"

namespace ir::passes {
namespace {

graph::BufferRef declare(graph::GraphBuilder& builder, graph::ResourceText text,
                         std::vector<graph::Field> fields, std::uint64_t elements) {
    return builder.buffer({.text = std::move(text),
                           .fields = std::move(fields),
                           .elements = elements,
                           .fingerprint = builder.inputs().geometry_fingerprint});
}

graph::BufferRef declare_nodes(graph::GraphBuilder& builder, std::uint64_t triangles) {
    return declare(builder,
                   {.key = "scene.bvh",
                    .label = "Nodes of the BVH",
                    .doc = "Bounds of the two children of each node. A child is the number of a node, or a "
                           "leaf: highest bit set, then 3 bits of how many triangles, 28 of the first one.",
                    .unit = "m"},
                   record_fields<BvhNode>(), std::max<std::uint64_t>(1, triangles));
}

graph::BufferRef declare_triangles(graph::GraphBuilder& builder, std::uint64_t triangles) {
    return declare(builder,
                   {.key = "scene.bvh.triangles",
                    .label = "Triangles of the BVH",
                    .doc = "Corners in the order of the leaves, number of the triangle in the scene, and 1 + "
                           "number of its mask (0: opaque).",
                    .unit = "m"},
                   record_fields<BvhTriangle>(), triangles);
}

graph::BufferRef declare_masks(graph::GraphBuilder& builder, std::uint64_t masked) {
    return declare(
        builder,
        {.key = "scene.bvh.masks",
         .label = "Masked triangles of the BVH",
         .doc = "Texture coordinates of the corners, and the material whose alpha mask is looked up."},
        record_fields<BvhMask>(), masked);
}

template <class T>
void fill(const graph::PassContext& context, graph::BufferRef ref, const std::vector<T>& data) {
    std::copy(data.begin(), data.end(), context.elements<T>(ref).begin());
}

void build(const graph::PassContext& context, const DeviceBvh& bvh) {
    const auto& inputs = context.inputs();
    const auto data = build_device_bvh(*inputs.scene, *inputs.world, inputs.threads);
    fill(context, bvh.nodes, data.nodes);
    fill(context, bvh.triangles, data.triangles);
    fill(context, bvh.masks, data.masks);
    if (data.left_out > 0)
        context.notes().warn(
            "ray tracing: " + std::to_string(data.left_out) +
            " triangles have corners that are not finite or beyond 1e18 m; no ray hits them");
}

}  // namespace

DeviceBvh device_bvh(graph::GraphBuilder& builder) {
    if (const auto known = graph::declared_buffer(builder, "scene.bvh"))
        return {*known, graph::declared_buffer(builder, "scene.bvh.triangles").value(),
                graph::declared_buffer(builder, "scene.bvh.masks").value()};
    const auto& world = *builder.inputs().world;
    DeviceBvh result;
    result.nodes = declare_nodes(builder, world.triangles());
    result.triangles = declare_triangles(builder, world.triangles());
    result.masks = declare_masks(builder, world.triangles() - world.opaque_triangles);
    builder.pass("device BVH", graph::Queue::cpu)
        .writes(result.nodes, result.triangles, result.masks)
        .execute([result](graph::PassContext& context) { build(context, result); });
    return result;
}

}  // namespace ir::passes
