#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderers/scene/world.h"

/// Highlights as wide as what a ray stands for: shaders/passes/scene/highlights.glsl on the host.
/// [Kaplanyan13]
namespace ir::passes {

/// Variance, along each axis, of the slopes of half vectors over the disc of this solid angle (sr) around a
/// ray that has come `distance_m` to the triangle.
float slope_variance(const scene::World& world, std::uint32_t triangle, float distance_m, float solid_angle);

/// Roughness of a highlight that is the mean over half vectors whose slopes vary by `variance` along each
/// axis.
float widened_roughness(float roughness, float variance);

/// How much more a highlight of its own roughness reflects than the widened one. `cosine`: to the ray.
float widened_gain(float own, float widened, float cosine);

}  // namespace ir::passes
