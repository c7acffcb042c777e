#pragma once

#include <string>

#include "renderers/core/record.h"
#include "renderers/graph/builder.h"
#include "renderers/passes/raytracing/device_bvh.h"
#include "renderers/passes/raytracing/layered_depth_cube.h"
#include "renderers/passes/scene/scene_buffers.h"
#include "shaders/passes/raytracing/rays.glsl.h"

namespace ir::passes {

/// What finds the first hits of rays that are in a buffer.
enum class Tracer { compute, embree, cube };

/// "KEY.rays" and "KEY.hits" with room for `rays`. Where all that they depend on stays, the rays may, too
/// (BufferDesc::fingerprint).
struct RayBuffers {
    graph::BufferRef rays, hits;
    std::uint64_t capacity = 0;
};
RayBuffers declare_rays(graph::GraphBuilder& builder, const std::string& key, std::uint64_t rays,
                        const std::string& fingerprint = {});

/// For a pass that traces on the device between other work of its own: it declares "Rays" and "Hits" itself.
class DeviceTracer {
  public:
    DeviceTracer(graph::GraphBuilder& builder, const SceneBuffers& scene);
    void declare_reads(graph::PassBuilder& pass) const;
    /// The rays [begin, end), after a barrier.
    static void trace(const graph::PassContext& context, std::int64_t begin, std::int64_t end);

  private:
    SceneBuffers scene_;
    DeviceBvh bvh_;
    graph::CounterRef unfinished_;
};

/// Declares the pass NAME: the first hit of each ray of the buffer, alpha masks respected. `compute` walks a
/// BVH on the device ("scene.bvh", built on the host once per world), `embree` queries the oracle on the
/// host, `cube` marches through layered depth maps there.
void trace_rays(graph::GraphBuilder& builder, const std::string& name, const SceneBuffers& scene,
                Tracer tracer, const RayBuffers& buffers, const CubeOptions& cube = {});

}  // namespace ir::passes
