#include "renderers/passes/raytracing/trace_rays.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/parallel_for.h"
#include "renderers/gl/dispatch_items.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/raytracing/bvh.h"

namespace ir::passes {
namespace {

constexpr std::int64_t lanes = 16;

/// The same as in trace.comp: neither NaN nor infinite.
bool is_ray(const RayRecord& ray) {
    const auto sum = ray.origin_ws + ray.direction_ws;
    return ray.far > 0 && std::isfinite(sum.x) && std::isfinite(sum.y) && std::isfinite(sum.z);
}

/// Traces up to sixteen rays.
void trace_packet(const Bvh& bvh, std::span<const RayRecord> rays, std::span<RayHitRecord> hits) {
    Bvh::Packet16 packet;
    for (std::size_t i = 0; i < lanes; ++i) {
        const bool active = i < rays.size() && is_ray(rays[i]);
        const auto ray = active ? rays[i] : RayRecord{{0, 0, 0}, 1, {0, 0, 1}, 0};
        packet.active[i] = active ? -1 : 0;
        packet.ox[i] = ray.origin_ws.x, packet.oy[i] = ray.origin_ws.y, packet.oz[i] = ray.origin_ws.z;
        packet.dx[i] = ray.direction_ws.x, packet.dy[i] = ray.direction_ws.y;
        packet.dz[i] = ray.direction_ws.z;
        packet.near[i] = 0, packet.far[i] = ray.far;
    }
    Hit found[lanes];
    bvh.closest_hits16(packet, false, found);
    for (std::size_t i = 0; i < rays.size(); ++i)
        hits[i] = {found[i].distance, found[i].triangle, found[i].u, found[i].v};
}

void trace_packets(const graph::PassContext& context, graph::ObjectRef bvh, const RayBuffers& buffers,
                   graph::Slice slice) {
    const auto rays = context.elements<const RayRecord>(buffers.rays);
    const auto hits = context.elements<RayHitRecord>(buffers.hits);
    const auto scene = context.object<Bvh>(bvh);
    const int threads = context.inputs().threads;
    parallel_for(threads, slice.begin, slice.end, [&](std::int64_t packet) {
        const auto first = static_cast<std::size_t>(packet * lanes);
        const auto count = std::min<std::size_t>(lanes, buffers.capacity - first);
        trace_packet(*scene, rays.subspan(first, count), hits.subspan(first, count));
    });
}

void trace_with_embree(graph::GraphBuilder& builder, const std::string& name, const RayBuffers& buffers) {
    const auto scene = bvh(builder);
    const auto packets = (static_cast<std::int64_t>(buffers.capacity) + lanes - 1) / lanes;
    builder.pass(name, graph::Queue::cpu)
        .reads(scene, buffers.rays)
        .writes(buffers.hits)
        .execute_sliced(packets, [=](graph::PassContext& context, graph::Slice slice) {
            trace_packets(context, scene, buffers, slice);
        });
}

void trace_with_cube(graph::GraphBuilder& builder, const std::string& name, const RayBuffers& buffers,
                     const CubeOptions& options) {
    const auto cube = layered_depth_cube(builder, options);
    builder.pass(name, graph::Queue::cpu)
        .reads(cube, buffers.rays)
        .writes(buffers.hits)
        .execute_sliced(static_cast<std::int64_t>(buffers.capacity), [=](graph::PassContext& context,
                                                                         graph::Slice slice) {
            const auto rays = context.elements<const RayRecord>(buffers.rays);
            const auto hits = context.elements<RayHitRecord>(buffers.hits);
            const auto scene = context.object<LayeredDepthCube>(cube);
            parallel_for(context.inputs().threads, slice.begin, slice.end, [&](std::int64_t i) {
                const auto& ray = rays[static_cast<std::size_t>(i)];
                const auto hit =
                    is_ray(ray) ? scene->closest_hit(ray.origin_ws, ray.direction_ws, ray.far) : Hit{};
                hits[static_cast<std::size_t>(i)] = {hit.distance, hit.triangle, hit.u, hit.v};
            });
        });
}

void trace_on_device(graph::GraphBuilder& builder, const std::string& name, const SceneBuffers& scene,
                     const RayBuffers& buffers) {
    const DeviceTracer tracer(builder, scene);
    auto pass = builder.pass(name);
    tracer.declare_reads(pass);
    pass.reads("Rays", buffers.rays)
        .writes("Hits", buffers.hits)
        .execute_sliced(static_cast<std::int64_t>(buffers.capacity),
                        [](graph::PassContext& context, graph::Slice slice) {
                            DeviceTracer::trace(context, slice.begin, slice.end);
                        });
}

}  // namespace

RayBuffers declare_rays(graph::GraphBuilder& builder, const std::string& key, std::uint64_t rays,
                        const std::string& fingerprint) {
    RayBuffers result;
    result.capacity = rays;
    result.rays = builder.buffer({.text = {.key = key + ".rays",
                                           .label = "Rays",
                                           .doc = "Rays that were traced last: origin, unit direction and "
                                                  "largest distance; 0: no ray.",
                                           .semantic = Semantic::position,
                                           .unit = "m"},
                                  .fields = record_fields<RayRecord>(),
                                  .elements = rays,
                                  .fingerprint = fingerprint});
    result.hits = builder.buffer({.text = {.key = key + ".hits",
                                           .label = "Hits of rays",
                                           .doc = "First hit of each ray: distance (infinite: none), "
                                                  "triangle, weights of its second and third corner.",
                                           .semantic = Semantic::depth,
                                           .unit = "m"},
                                  .fields = record_fields<RayHitRecord>(),
                                  .elements = rays});
    return result;
}

DeviceTracer::DeviceTracer(graph::GraphBuilder& builder, const SceneBuffers& scene)
    : scene_(scene),
      bvh_(device_bvh(builder)),
      unfinished_(
          builder.counter({.key = "raytracing.unfinished",
                           .label = "Unfinished rays",
                           .doc = "Rays that met more nodes than a traversal may visit; their hit may "
                                  "not be the first one."})) {}

void DeviceTracer::declare_reads(graph::PassBuilder& pass) const {
    pass.reads("BvhNodes", bvh_.nodes)
        .reads("BvhTriangles", bvh_.triangles)
        .reads("BvhMasks", bvh_.masks)
        .reads(scene_.opacity, scene_.opacity_words)
        .counts("Unfinished", unfinished_);
}

void DeviceTracer::trace(const graph::PassContext& context, std::int64_t begin, std::int64_t end) {
    gl::dispatch_items(context.use({{"passes/raytracing/trace.comp"}}), begin, end);
}

void trace_rays(graph::GraphBuilder& builder, const std::string& name, const SceneBuffers& scene,
                Tracer tracer, const RayBuffers& buffers, const CubeOptions& cube) {
    if (tracer == Tracer::compute)
        trace_on_device(builder, name, scene, buffers);
    else if (tracer == Tracer::embree)
        trace_with_embree(builder, name, buffers);
    else
        trace_with_cube(builder, name, buffers, cube);
}

}  // namespace ir::passes
