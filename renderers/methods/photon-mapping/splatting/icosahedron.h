#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace ir::methods::photon_mapping {

/// A regular icosahedron with its vertices on the unit sphere; corners run anticlockwise seen from outside.
struct Icosahedron {
    std::array<glm::vec3, 12> vertices;
    std::array<std::uint32_t, 60> corners;
};
Icosahedron icosahedron();

}  // namespace ir::methods::photon_mapping
