#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderers/scene/scene.h"

namespace ir::scene {

/// Where a scene has room: a coarse grid of cells that surfaces pass through, or that are free.
class FreeSpace {
  public:
    /// At time 0. The longest side of the bounds has at most 64 cells; fewer where surfaces are so large or
    /// many that more would take long. A scene without triangles has no cells.
    explicit FreeSpace(const Scene& scene);

    bool empty() const { return cells_.empty(); }
    const Bounds& bounds() const { return bounds_; }
    float cell_size() const { return cell_size_; }
    /// Cells along each axis; the outermost ones on each side lie outside of the bounds.
    glm::ivec3 size() const { return size_; }
    glm::vec3 centre_of(glm::ivec3 cell) const;
    /// Cells to the nearest surface: 0 in a cell with one, 1 beside it. The bounds are no surface.
    int clearance(glm::ivec3 cell) const;

    /// What a ray meets first.
    struct Hit {
        float distance = 0;  ///< m
        /// Cosine between the ray and the way against the surface's normal: 1 straight onto its front, -1
        /// onto its back; near 0 where sides of all kinds share the cell.
        float facing = 0;
        /// Area of all surfaces in the cell, in areas of its side: about 1 of a plain wall, more of things with
        /// details.
        float detail = 0;
        int material = 0;  ///< of a surface in the cell, index into Scene::materials
    };
    /// Absent where the ray leaves the grid. The direction has unit length.
    std::optional<Hit> ray(glm::vec3 origin_ws, glm::vec3 direction_ws) const;

  private:
    struct Cell {
        glm::vec3 normal{0};  ///< sum over surfaces, by area
        float area = 0;
        int material = 0;
    };
    std::size_t index(glm::ivec3 cell) const;
    bool contains(glm::ivec3 cell) const;
    void add_triangle(const glm::vec3 (&corners)[3], glm::vec3 normal, int material);
    void find_clearances();

    Bounds bounds_;
    glm::vec3 origin_{0};
    glm::ivec3 size_{0};
    float cell_size_ = 1;
    std::vector<Cell> cells_;
    std::vector<std::uint8_t> clearances_;  ///< of the cells; at most 255
};

}  // namespace ir::scene
