#pragma once

#include "renderers/methods/photon-mapping/tracing.h"
#include "renderers/passes/scene/hit_surfaces.h"

namespace ir::methods::photon_mapping {

/// What photons are culled by; equals struct CullingView of culling.glsl.
struct CullingView {
    glm::mat4 sides;    ///< columns: planes through the picture's edges, unit normals inwards
    glm::vec4 eye_ws;   ///< w = 1; for parallel rays the direction towards the camera, w = 0
    float reach;        ///< m: longest half-axis that a kernel can have where it is not widened to texels
    float texel_reach;  ///< the same of kernels that are: per m of distance, or for parallel rays m
};
CullingView culling_view(const scene::View& view, const Parameters& parameters, float scene_radius);

/// All paths of a frame, surface by surface. Buffers have one element a path.
class Wavefront {
  public:
    Wavefront(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const SamplePoints& samples,
              const Parameters& parameters);

    /// The first scattering, at the sample points.
    void leave(graph::GraphBuilder& builder, const Photons& photons) const;
    /// From surface `number` - 1 (0: the sample point) to surface `number`: rays, photons, next scattering.
    void advance(graph::GraphBuilder& builder, int number, const Photons& photons) const;
    /// Surfaces along a path, mirrors included.
    int surfaces() const { return bounces_ + mirrors_; }
    /// Rows of the tally: the sample points, and each bounce.
    int rows() const { return bounces_ + 1; }
    /// Sums of shaders/methods/photon-mapping/tracing/tally.glsl.
    graph::BufferRef sums() const { return sums_; }

  private:
    void land(graph::GraphBuilder& builder, int number, const Photons& photons) const;
    void store(graph::GraphBuilder& builder, int number, graph::BufferRef places,
               const Photons& photons) const;
    void set_path_rules(const graph::PassContext& context, const gl::Program& program) const;
    void over_paths(const gl::Program& program, graph::Slice slice) const;

    passes::SceneBuffers scene_;
    SamplePoints samples_;
    Parameters parameters_;
    passes::HitSurfaces surfaces_;
    passes::RayBuffers rays_;
    graph::BufferRef paths_, landed_, flags_, bases_, sums_;
    int bounces_ = 1, mirrors_ = 0;
};

}  // namespace ir::methods::photon_mapping
