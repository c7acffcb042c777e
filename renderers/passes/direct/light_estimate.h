#pragma once

#include <glm/glm.hpp>
#include <span>

#include "renderers/core/transport.h"
#include "renderers/passes/direct/panes.h"
#include "renderers/passes/lights/light_sampler.h"
#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/sampling/point_sequence.h"
#include "renderers/passes/sampling/power_heuristic.h"
#include "renderers/passes/surface/surface.h"

namespace ir::passes {

/// Light that a surface reflects of sources with an extent, one sample at a time: of the sources and of the
/// surface's directions, weighted against each other. What lies between is opaque but for alpha masks and
/// sheets of clear glass: light that glass refracts or mirrors is not found. Keeps references. Thread-safe.
class LightEstimate {
  public:
    struct Options {
        Transport::Materials materials = Transport::Materials::gltf;
        /// Of what lies between: with `lambert` glass is opaque.
        Transport::Materials between = Transport::Materials::gltf;
        /// Whether mirrors, which scatter nothing, show the sources that they reflect.
        bool mirrors = true;
        /// Tests put a wrong weight in its place, which they must notice.
        float (*combine)(float pdf, float other) = power_heuristic;
    };

    /// `lights` without punctual ones, over `surfaces`, whose scene still exists.
    LightEstimate(const Bvh& bvh, const SurfaceLookup& surfaces, const LightSampler& lights,
                  const Options& options);

    /// Radiance towards unit direction `wo`, W/(m² sr), unbiased over the keys of the sampler.
    glm::vec3 sample(const Surface& surface, glm::vec3 wo, const PathSampler& sampler) const {
        glm::vec3 radiance;
        sample(surface, wo, {&sampler, 1}, {&radiance, 1});
        return radiance;
    }
    /// The same of as many samplers, at a lower price each. What one gives does not depend on the others.
    void sample(const Surface& surface, glm::vec3 wo, std::span<const PathSampler> samplers,
                std::span<glm::vec3> radiances) const;
    /// Reflectance of the surface, by which noise is measured; 0 where it is unlit.
    glm::vec3 reflectance(const Surface& surface) const;

  private:
    struct Receiver;
    struct Pending;
    void towards_sources(Receiver& receiver, std::span<const PathSampler> samplers, const Lanes& choices,
                         std::span<glm::vec3> radiances) const;
    void by_directions(Receiver& receiver, std::span<const PathSampler> samplers, const Lanes& lobes,
                       std::span<glm::vec3> radiances) const;
    glm::vec3 met_sources(Receiver& receiver, glm::vec3 direction, float pdf,
                          const Panes::Sight& sight) const;

    const Bvh& bvh_;
    const SurfaceLookup& surfaces_;
    const LightSampler& lights_;
    Options options_;
    Panes panes_;
};

}  // namespace ir::passes
