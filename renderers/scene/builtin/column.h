#pragma once

#include "renderers/scene/builtin/mesh_builder.h"

namespace ir::scene::builtin {

/// A column with plinth, attic base, swelling shaft, leafed capital and abacus.
struct Column {
    glm::vec3 foot;
    float height;    ///< from the foot to the top of the abacus, metres
    float radius;    ///< of the shaft's foot, metres
    int flutes = 0;  ///< 0: a smooth shaft
};

/// Half side of a column's plinth and abacus.
float plinth_half(const Column& column);

void column(MeshBuilder& b, const Column& column, int segments);

/// A turned stone baluster.
void baluster(MeshBuilder& b, glm::vec3 foot, float height, int segments, int rows);

}  // namespace ir::scene::builtin
