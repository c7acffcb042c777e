#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "renderers/passes/surface/surface.h"

namespace ir::passes {

/// Light that leaves a source along one ray.
struct EmittedLight {
    /// On the source; of directional lights and the environment where they enter the scene's bounds
    /// (EntryBox).
    glm::vec3 origin_ws{0};
    glm::vec3 direction_ws{0};  ///< of travel, unit length
    glm::vec3 normal_ws{0};     ///< unit, of the surface that it leaves, on that side; of lights without a
                                ///< surface the direction
    glm::vec3 flux{0};  ///< W that a ray stands for if it is the only one; each of n rays has 1/n of it
    float range = 0;    ///< m, after which a point or spot light ends (range_window()); 0: nowhere
    int emitter = 0;    ///< index of the world's light, or one of EmissionSampler's constants
    std::uint32_t triangle = 0;  ///< of the world, where it is an emissive mesh
    float area_pdf = 0;       ///< of the origin, 1/m², choice of the emitter left out, of what is infinitely
                              ///< far across the direction; 0: a point
    float direction_pdf = 0;  ///< of the direction from there, 1/sr; 0: the only one
    float probability = 0;    ///< with which this emitter was chosen
    bool has_extent = true;   ///< rays can meet it

    /// Of the rays from all emitters that come along this one, after a distance in m: 1/(m² sr) across it; of
    /// lights without extent 1/m².
    float density(float distance) const;
};

struct EmissionOptions {
    std::vector<int> lights = {};  ///< indices of the world's that are to send light, of any type
    bool environment = true, emissive_meshes = true;
};

/// Where light starts, what for and how much: the counterpart of LightSampler, for photons. Emitters are
/// chosen by their power, points on them uniformly in area and directions by the cosine, so that all rays of
/// untextured emitters have the same flux. The environment shines through the scene's bounds; much of it
/// misses what they hold, so that it is chosen at most three times as often as all others together. Keeps a
/// pointer to the surfaces. Thread-safe.
class EmissionSampler {
  public:
    using Options = EmissionOptions;
    static constexpr int emissive_mesh = -1, environment = -2;  ///< as emitters

    EmissionSampler(const SurfaceLookup& surfaces, const Options& options);
    ~EmissionSampler();
    EmissionSampler(const EmissionSampler&) = delete;

    bool empty() const;  ///< nothing emits
    /// W of all emitters, mean of the channels: exact but for textures, which are averaged as TriangleLights
    /// does, for emission maps' colours, and for environment maps, which count as if they shone evenly.
    float power() const;
    float power(int emitter) const;  ///< of one light, of all emissive triangles, of the environment

    /// Which emitter a number chooses: in order the lights, emissive meshes, the environment.
    int emitter(float choice) const;
    /// `choice` and both pairs in [0, 1): neighbouring numbers give neighbouring rays. Nothing where the
    /// emitter sends no light there: in the holes of alpha masks and dark texels.
    std::optional<EmittedLight> sample(float choice, glm::vec2 place, glm::vec2 direction) const;

    /// EmittedLight::density() of a ray in this direction of travel that comes from an emitter, of an
    /// emissive mesh from a triangle of the world; 0 where sample() sends none.
    float density(int emitter, std::uint32_t triangle, glm::vec3 direction_ws, float distance) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace ir::passes
