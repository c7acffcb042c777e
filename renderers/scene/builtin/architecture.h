#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderers/scene/builtin/mesh_builder.h"

/// Parts of buildings, in metres, added to a MeshBuilder in its current space.
namespace ir::scene::builtin {

inline constexpr float crease = 0.82f;  ///< cosine of the bend that stays sharp, 35°

/// A cross section: the solid lies to the left of the way, so for a profile of (radius, height) that climbs,
/// outside is at larger radii. Bends above 35° stay sharp.
using Profile = std::vector<glm::vec2>;

/// Appends an arc around `centre`; angles in degrees, both ends included.
void add_arc(Profile& profile, glm::vec2 centre, float radius, float from, float to, int segments);

/// Where a profile point (p.x, p.y) goes: origin + p.x · x + p.y · y.
struct Frame {
    glm::vec3 origin, x, y;
};

/// Carries a profile through frames.
void sweep(MeshBuilder& b, const Profile& profile, std::vector<Frame> frames);

/// Turns a profile of (radius, height) around the vertical axis through `centre`.
void lathe(MeshBuilder& b, glm::vec3 centre, const Profile& profile, int segments);

/// Turns a profile of (radius, height along the axis y) by part of a circle in the plane of x and z.
std::vector<Frame> arc_frames(glm::vec3 centre, glm::vec3 x, glm::vec3 y, float from, float to, int segments);

/// A closed ring around the y axis between two rectangles, given by half sides (x, z), with mitred corners.
struct Ring {
    glm::vec2 outer, inner;
    float outer_bottom, outer_top, inner_bottom, inner_top;
};
void ring(MeshBuilder& b, const Ring& ring);

/// A profile of (distance inwards, height) along the inside of a rectangle, mitred.
void inner_moulding(MeshBuilder& b, glm::vec2 half, const Profile& profile);

/// A wall in the plane of x and y, centred on x = 0, from z = -depth to 0 (its front), with a round-headed
/// opening. Where `sill` is the bottom, the opening reaches down to it and the wall stands on two feet.
struct ArchedPanel {
    float width, bottom, top;
    float sill, spring, radius;
    float depth;
    bool has_back = true;
};
void arched_panel(MeshBuilder& b, const ArchedPanel& panel, int segments);

/// Groin vault over a rectangle (x0, z0)…(x1, z1): the higher of two crossing elliptic barrels.
void groin_vault(MeshBuilder& b, glm::vec2 low, glm::vec2 high, float spring, float rise, int segments);

/// Half an elliptic arch in the plane of z and y over 0 ≤ z ≤ span, seen from below and from both sides.
void rib(MeshBuilder& b, float span, float spring, float rise, float width, float depth, int segments);

/// A round bar from a to b without caps.
void rod(MeshBuilder& b, glm::vec3 a, glm::vec3 c, float radius, int segments);

}  // namespace ir::scene::builtin
