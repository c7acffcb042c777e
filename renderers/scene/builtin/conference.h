#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "renderers/scene/builtin/detail.h"
#include "renderers/scene/builtin/mesh_builder.h"

/// Measures and parts of the conference room; metres.
namespace ir::scene::builtin::conference_parts {

constexpr glm::vec3 room_low{-4.5f, 0, -3}, room_high{4.5f, 2.9f, 3};
constexpr float wall = 0.2f;       ///< thickness
constexpr float recess = 0.15f;    ///< of the lamps into the ceiling
constexpr float lamp_half = 0.3f;  ///< half side of a recess
constexpr float table_top = 0.75f;

struct Materials {
    int wall, carpet, ceiling, panelling, table, door, metal, black, pane, blind, board, lamp, paper, china,
        vase;
    int leaf, cushions[2], picture;
};

/// Middles of the lamps' recesses in the ceiling's plane, in one row or two.
std::vector<glm::vec3> lamp_places(int count);

void add_room(Scene& scene, const Materials& m, const std::vector<glm::vec3>& lamps);
void add_fittings(Scene& scene, const Materials& m, const Detail& detail);   // windows, door, board
void add_furniture(Scene& scene, const Materials& m, const Detail& detail);  // table, chairs, sideboard

}  // namespace ir::scene::builtin::conference_parts
