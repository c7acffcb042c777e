#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "renderers/passes/lights/light_tree.h"
#include "renderers/passes/surface/surface.h"

namespace ir::passes {

class EnvironmentLight;
struct EmittedLight;
class FlatLight;
class LightChoice;
class TriangleLights;

/// One direction towards the light of a scene.
struct LightSample {
    glm::vec3 direction_ws{0};  ///< unit, from the point to the light
    float distance = 0;         ///< to the light, m; infinite for directional lights and the environment
    glm::vec3 radiance{0};      ///< W/(m² sr) that arrives unless something is in between; of lights without
                                ///< extent the irradiance on a surface that faces them, W/m²
    float pdf = 0;  ///< per solid angle, choice of the light included; without extent the choice alone
    bool is_delta = false;       ///< a light without extent, which no ray can hit
    int emitter = 0;             ///< as EmittedLight::emitter
    std::uint32_t triangle = 0;  ///< of the world, where that is an emissive mesh
};

/// What a ray meets of rectangle and disk lights, which are not in the BVH and stop no ray.
struct LightHit {
    float distance = 0;
    glm::vec3 radiance{0};
    int light = -1;   ///< number among those that are sampled, for pdf_of_light()
    int emitter = 0;  ///< index of the world's light
};

struct LightSamplerOptions {
    bool punctual = true;  ///< point, spot and directional lights
    bool environment = true;
    bool emissive_meshes = true;
    bool lamps = true;  ///< rectangle and disk lights
};

/// Everything in a scene that emits: point, spot, directional, rectangle and disk lights, emissive triangles,
/// the environment. Rectangles and disks send light from the side to which they point. Chooses with
/// probabilities that never exclude what could contribute. Keeps a pointer to the surfaces. Thread-safe.
class LightSampler {
  public:
    using Options = LightSamplerOptions;
    explicit LightSampler(const SurfaceLookup& surfaces, const Options& options = {});
    ~LightSampler();
    LightSampler(const LightSampler&) = delete;

    bool empty() const;  ///< nothing emits

    /// `choice` and `u` uniform in [0, 1). Nothing where the light chosen sends none there.
    std::optional<LightSample> sample(LightReceiver& receiver, float choice, glm::vec2 u) const;
    /// The same of a single sample, for a point with this unit geometric normal.
    std::optional<LightSample> sample(glm::vec3 position_ws, glm::vec3 normal_ws, float choice,
                                      glm::vec2 u) const {
        LightReceiver receiver(position_ws, normal_ws);
        return sample(receiver, choice, u);
    }

    /// Densities with which sample() there would have chosen what a ray from there met: for multiple
    /// importance sampling. Per solid angle, choice included.
    float pdf_of_triangle(LightReceiver& receiver, const Hit& hit) const;
    float pdf_of_light(LightReceiver& receiver, glm::vec3 direction_ws, const LightHit& hit) const;
    float pdf_of_environment(glm::vec3 normal_ws, glm::vec3 direction_ws) const;
    /// The same of a single ray.
    float pdf_of_triangle(glm::vec3 position_ws, glm::vec3 normal_ws, const Hit& hit) const {
        LightReceiver receiver(position_ws, normal_ws);
        return pdf_of_triangle(receiver, hit);
    }
    float pdf_of_light(glm::vec3 position_ws, glm::vec3 normal_ws, glm::vec3 direction_ws,
                       const LightHit& hit) const {
        LightReceiver receiver(position_ws, normal_ws);
        return pdf_of_light(receiver, direction_ws, hit);
    }
    /// The same for a ray from a light that arrives at that point; 0 of what is not sampled here.
    float pdf_of_arrival(glm::vec3 position_ws, glm::vec3 normal_ws, const EmittedLight& light) const;

    /// Radiance from infinity, 0 where the options leave it out.
    glm::vec3 environment(glm::vec3 direction_ws) const;
    bool has_environment() const;
    bool has_emissive_meshes() const;
    /// Whether rays can meet any of the sources.
    bool has_extent() const { return has_environment() || has_emissive_meshes() || extended_lights() > 0; }
    /// False only where a ray along a unit direction meets no source, whatever is in between.
    bool may_meet(glm::vec3 origin_ws, glm::vec3 direction_ws) const;
    /// Rectangles and disks that a ray meets within (0, far), in no order; calls `visit` for each.
    template <class Visit>
    void visit_lights(glm::vec3 origin_ws, glm::vec3 direction_ws, float far, Visit visit) const {
        for (int i = 0; i < extended_lights(); ++i)
            if (const auto hit = intersect(i, origin_ws, direction_ws, far)) visit(*hit);
    }

    // What it is made of, for the device.
    const LightChoice& choice() const;
    std::vector<FlatLight> lamps() const;
    const TriangleLights* triangles() const;            ///< null where the options leave them out
    const EnvironmentLight* environment_light() const;  ///< likewise

  private:
    int extended_lights() const;
    std::optional<LightHit> intersect(int index, glm::vec3 origin_ws, glm::vec3 direction_ws,
                                      float far) const;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace ir::passes
