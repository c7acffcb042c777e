#pragma once

#include <glm/glm.hpp>
#include <span>

#include "renderers/methods/ldm-indirect/tracing/landing.h"
#include "shaders/methods/ldm-indirect/tracing/differentials.glsl.h"
#include "shaders/methods/ldm-indirect/tracing/primary.glsl.h"

namespace ir::methods::ldm_indirect {

/// As the structs of landing.glsl.
struct Spread {
    float at_start, by_distance;
    bool is_beam;
};
struct Landing {
    Cause cause;
    float distance;       ///< m along the ray
    glm::vec3 normal_ws;  ///< of the receiver, on the viewer's side
};
/// A photon on its way: what landing() of landing.glsl is given.
struct Arrival {
    glm::vec3 origin, direction;
    float distance, error;  ///< m
    glm::vec3 step_u, step_v;
    Spread spread;
    glm::vec3 map_normal;
    bool has_surface = false;
};

/// How far along the ray a map's entry may lie from where the ray meets a surface with normal n.
float entry_error(const glm::vec3& normal, const glm::vec3& direction, const glm::vec3& step_u,
                  const glm::vec3& step_v);

/// The camera's view, in which photons arrive; what tracing/landing.glsl does on the device.
/// [Aalund15 §4.2, step 4b]
class LandingView {
  public:
    LandingView(const LandingConstants& constants, const Parameters& parameters, glm::ivec2 size,
                std::span<const glm::vec4> position, std::span<const glm::vec4> geometric_normal);
    Landing land(const Arrival& arrival) const;

  private:
    bool shown_at(const glm::vec3& position_ws, std::size_t& pixel) const;
    bool may_reach_view(const glm::vec3& position_ws, const glm::vec3& first_ws, const glm::vec3& last_ws,
                        float longer, float thicker) const;
    Landing unseen(const Arrival& a, bool is_inside, float distance, const glm::vec3& normal) const;

    LandingConstants c_;
    bool reject_hidden_;
    float tolerance_;
    glm::ivec2 size_;
    std::span<const glm::vec4> position_, geometric_normal_;
    glm::vec4 depth_row_;  ///< of clip_from_world
    glm::vec4 sides_[5];   ///< planes of the view, with their normals' lengths
    float side_lengths_[5];
};

}  // namespace ir::methods::ldm_indirect
