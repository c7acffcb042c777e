#pragma once

#include "renderers/methods/photon-mapping/stages.h"
#include "renderers/passes/scene/hit_surfaces.h"

namespace ir::methods::photon_mapping {

/// All paths of a frame, surface by surface. Buffers have one element a path.
class Wavefront {
  public:
    Wavefront(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const SamplePoints& samples,
              const Parameters& parameters);

    /// The first scattering, at the sample points.
    void leave(graph::GraphBuilder& builder, const Photons& photons) const;
    /// From surface `number` - 1 (0: the sample point) to surface `number`: rays, photons, next scattering.
    void advance(graph::GraphBuilder& builder, int number, const Photons& photons) const;
    /// What the paths met, kept where a view asks for it.
    const PhotonLegs& legs() const { return legs_; }
    /// Surfaces along a path, mirrors and glass included; behind them the first one that scatters is met,
    /// too.
    int surfaces() const { return bounces_ + (mirrors_ > 0 ? mirrors_ + 1 : 0); }
    /// Rows of the tally: the sample points, and each bounce.
    int rows() const { return bounces_ + 1; }
    /// Sums of shaders/methods/photon-mapping/tracing/tally.glsl.
    graph::BufferRef sums() const { return sums_; }

  private:
    /// Light that mirrors and clear glass send on before anything scatters it is direct light, which shadow
    /// maps and light samples do not show.
    bool keeps_mirrored() const {
        return mirrors_ > 0 && parameters_.transport.paths == Transport::Paths::full;
    }
    void follow(graph::GraphBuilder& builder, int number) const;
    void land(graph::GraphBuilder& builder, int number, const Photons& photons) const;
    void store(graph::GraphBuilder& builder, int number, graph::BufferRef places,
               const Photons& photons) const;

    passes::SceneBuffers scene_;
    SamplePoints samples_;
    Parameters parameters_;
    passes::HitSurfaces surfaces_;
    passes::RayBuffers rays_;
    PhotonLegs legs_;
    graph::BufferRef paths_, landed_, flags_, bases_, sums_;
    int bounces_ = 1, mirrors_ = 0;  ///< mirrors and clear glass
};

}  // namespace ir::methods::photon_mapping
