#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "renderers/scene/builtin/detail.h"
#include "renderers/scene/builtin/mesh_builder.h"

/// Measures and parts of the cathedral; metres. x along the nave towards the apse, z across, the floor at y =
/// 0.
namespace ir::scene::builtin::cathedral_parts {

constexpr int bays = 6;
constexpr float bay = 4.5f, nave_end = 0.5f * bays * bay;       ///< the nave lies between x = ±nave_end
constexpr float nave = 4.2f;                                    ///< half its width
constexpr float arcade_back = 5, aisle = 8.6f, outside = 9.5f;  ///< |z| of the walls' faces
// Storeys of the nave's wall, from below.
constexpr float arcade_spring = 3.6f, arcade_radius = 1.6f, arcade_top = 6.3f, triforium_top = 8.5f;
constexpr float vault_spring = 9.6f, vault_rise = 3.6f, vault_top = 13.6f;
constexpr float aisle_rise = 2, aisle_top = 6.1f;
constexpr float choir_from = 9, choir_height = 0.45f;  ///< three steps above the nave

/// Middle of a bay, and the axis of the piers before it.
constexpr float bay_middle(int i) {
    return -nave_end + bay * (static_cast<float>(i) + 0.5f);
}
constexpr float pier_axis(int i) {
    return -nave_end + bay * static_cast<float>(i);
}
constexpr float pier_z = 0.5f * (nave + arcade_back);

struct Materials {
    int stone, pale, vault, tiles, marble, wood, bronze, cloth, wax;
};
Materials add_materials(Scene& scene);

void add_arcades(Scene& scene, const Materials& materials,
                 const Detail& detail);  // the walls along nave and aisles
void add_piers(Scene& scene, const Materials& materials, const Detail& detail);
void add_vaults(Scene& scene, const Materials& materials, const Detail& detail);
void add_apse(Scene& scene, const Materials& materials, const Detail& detail);
void add_west_front(Scene& scene, const Materials& materials, const Detail& detail);
void add_furniture(Scene& scene, const Materials& materials, const Detail& detail);

/// Both sides of the nave: as it is, and turned by half a turn around the vertical axis.
glm::mat4 side_transform(int side);

/// Part of an ellipse upright over the way from `from` to `to`, of `rise` above them: frames whose x points
/// to the middle and whose y lies across the way; the parameter is an angle, 0° at `from` and 180° at `to`.
struct Bow {
    glm::vec3 from, to;
    float rise;
    float begin = 0, end = 180;
};
struct BowFrame {
    glm::vec3 point, inwards, across;
};
std::vector<BowFrame> bow_points(const Bow& bow, int segments);
/// A rib of `width`, half sunk in the vault, with a roll at its front; closed.
void add_rib(MeshBuilder& b, const Bow& bow, float width, int segments);

}  // namespace ir::scene::builtin::cathedral_parts
