#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

/// What crosses the border between plain code and vectors: sixteen of everything, a plane for each part.
namespace ir::passes {

constexpr std::size_t lane_count = 16;
using Lanes = std::array<float, lane_count>;

struct Lanes2 {
    alignas(64) Lanes x{}, y{};
};

struct Lanes3 {
    alignas(64) Lanes x{}, y{}, z{};

    glm::vec3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }
    void put(std::size_t i, glm::vec3 value) { x[i] = value.x, y[i] = value.y, z[i] = value.z; }
};

}  // namespace ir::passes
