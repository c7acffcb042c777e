#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "renderers/scene/builtin/detail.h"
#include "renderers/scene/builtin/mesh_builder.h"

/// Measures and parts of the atrium; metres.
namespace ir::scene::builtin::atrium_parts {

constexpr float bay = 2.8f;              ///< between two columns
constexpr glm::vec2 court{11.2f, 4.2f};  ///< half sides of the rectangle of the column axes
constexpr glm::vec2 wall{14.5f, 8.5f};   ///< half sides of the outer walls' inner faces
constexpr float leaf_depth = 0.25f;      ///< of the blind arcade in front of the outer walls
constexpr float court_floor = -0.34f, gallery_floor = 5.6f, ceiling = 5.2f;
constexpr float lower_spring = 3.3f, upper_spring = 8.4f, upper_wall_top = 10.62f;
constexpr float lower_arch = 1.05f, upper_arch = 1.12f;  ///< radii
constexpr float lower_depth = 0.6f, upper_depth = 0.5f;  ///< of the arcades' walls

/// One side of the court. In its space x runs along the column axes, the origin is in their middle, z points
/// away from the court and y up.
struct Side {
    glm::mat4 transform;
    int bays;
    float half() const { return 0.5f * bay * bays; }
    float to_wall;    ///< from the column axes to the outer wall
    float wall_half;  ///< half length of the outer wall
};
const std::array<Side, 4>& sides();

struct Materials {
    int limestone, plaster, vault, bricks, tiles, paving, wood, roof, iron, bronze, lamp, water, leaf, grille;
    int cloth[3];
};
Materials add_materials(Scene& scene);

void add_masonry(Scene& scene, const Materials& materials, const Detail& detail);     // walls, floors, vaults
void add_colonnades(Scene& scene, const Materials& materials, const Detail& detail);  // columns, balustrades
void add_roof(Scene& scene, const Materials& materials, const Detail& detail);
void add_drapes(Scene& scene, const Materials& materials, const Detail& detail);
void add_furnishings(Scene& scene, const Materials& materials,
                     const Detail& detail);  // fountain, plants, lamps

}  // namespace ir::scene::builtin::atrium_parts
