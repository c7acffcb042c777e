#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderers/scene/builtin/architecture.h"
#include "renderers/scene/builtin/mesh_builder.h"

/// Closed bodies that are cut from a plane figure or follow a way; metres, added in the builder's space.
namespace ir::scene::builtin {

/// A plane figure, counter-clockwise; all of it is seen from `Plate::middle`.
using Outline = std::vector<glm::vec2>;

/// An outline in the plane of x and y, between z = back and z = front, whose edges there are bevelled by
/// `bevel`.
struct Plate {
    Outline outline;
    float back, front, bevel;
    glm::vec2 middle{0};
    glm::vec2 uv{0};  ///< added to the texture coordinates
};
void plate(MeshBuilder& b, const Plate& plate);

/// The same lying: the outline is in the plane of x and −z, `back` and `front` are heights.
void lying_plate(MeshBuilder& b, const Plate& plate);

Outline rectangle(glm::vec2 low, glm::vec2 high);

/// A box whose edges across z (or y, where it lies) are bevelled: 28 triangles.
void block(MeshBuilder& b, glm::vec3 min, glm::vec3 max, float bevel, glm::vec2 uv = {0, 0});
void lying_block(MeshBuilder& b, glm::vec3 min, glm::vec3 max, float bevel, glm::vec2 uv = {0, 0});

/// A round body along a way, with a radius at each of its points, closed at both ends.
void limb(MeshBuilder& b, std::span<const glm::vec3> way, std::span<const float> radii, int around);

/// Carries a closed profile, counter-clockwise without its first point again, through frames and closes both
/// ends; all of the profile is seen from the mean of its points.
void moulding(MeshBuilder& b, Profile profile, const std::vector<Frame>& frames);

/// The same once around: the last frame is the first.
void round_moulding(MeshBuilder& b, Profile profile, const std::vector<Frame>& frames);

}  // namespace ir::scene::builtin
