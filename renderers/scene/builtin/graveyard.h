#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <span>

#include "renderers/scene/builtin/detail.h"
#include "renderers/scene/builtin/mesh_builder.h"

/// Measures and parts of the graveyard; metres. x to the right along the back wall, z towards the viewer.
namespace ir::scene::builtin::graveyard_parts {

struct Materials {
    int soil, grass, dry_grass, bricks, mortar, iron, bark, ivy, flower;
    std::array<int, 3> stone;  ///< granite, sandstone, slate
};
Materials add_materials(Scene& scene);

enum class Kind { round_slab, pointed_slab, shouldered_slab, latin_cross, ring_cross, obelisk, table_tomb };

/// Where a grave is. Its stone faces +z before it is turned.
struct Plot {
    Kind kind;
    glm::vec2 place;  ///< x, z
    float size;       ///< scales the stone
    int stone;        ///< of Materials::stone
};
std::span<const Plot> plots();

// Inner faces of the wall: it runs along x at the back and along z on the left, and they meet in a corner.
constexpr glm::vec2 wall_corner{-5.2f, -4.6f};
constexpr float wall_thickness = 0.23f, wall_height = 1.92f;
constexpr float gate_left = 0.1f, gate_right = 2.3f;  ///< inner faces of the gate's piers
constexpr float fence_end = 8.6f, left_wall_end = 5.2f;
constexpr glm::vec2 tree_place{3.35f, -2.55f};

/// Ground level at x, z.
float ground_height(glm::vec2 place);
/// Where the path from the gate runs.
float path_middle(float z);

void add_ground(Scene& scene, const Materials& materials, const Detail& detail);  // with stones and path
void add_walls(Scene& scene, const Materials& materials, const Detail& detail);
void add_ironwork(Scene& scene, const Materials& materials, const Detail& detail);
void add_gravestones(Scene& scene, const Materials& materials, const Detail& detail);
void add_tree(Scene& scene, const Materials& materials, const Detail& detail);
void add_ivy(Scene& scene, const Materials& materials, const Detail& detail);
/// Blades until the scene has `triangles`.
void add_grass(Scene& scene, const Materials& materials, std::size_t triangles);

}  // namespace ir::scene::builtin::graveyard_parts
