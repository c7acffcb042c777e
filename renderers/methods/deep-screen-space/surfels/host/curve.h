#pragma once

#include <vector>

#include "renderers/methods/deep-screen-space/surfels/view.h"
#include "renderers/scene/world.h"
#include "shaders/methods/deep-screen-space/surfels/patch.glsl.h"

namespace ir::methods::deep_screen_space {

/// A patch, and what it is worth in units of which a surfel has units_of_surfel.
struct WorthOfPatch {
    Patch patch;
    std::uint32_t units;
};

/// The curve through all patches along which surfels are placed systematically: split.comp, patch.glsl and
/// place.comp on the host. Thread-safe.
class Curve {
  public:
    Curve(const scene::World& world, const Ideal& ideal, const Frustum& frustum, unsigned seed)
        : world_(world), ideal_(ideal), frustum_(frustum), seed_(seed) {}

    /// Appends the parts of a triangle that are left, in their order.
    void cut(std::uint32_t triangle, std::vector<WorthOfPatch>& patches) const;

    /// Weights of the triangle's second and third corner at a place of the curve, of which the patch has
    /// [0, 1).
    glm::vec2 weights_on(const Patch& patch, float place) const;
    glm::vec3 position(std::uint32_t triangle, glm::vec2 weights) const;
    glm::vec3 normal(std::uint32_t triangle) const;  ///< unit, by the winding
    float ideal_area_of(const Patch& patch) const;   ///< m², in its middle

  private:
    struct Corners {
        glm::vec3 a, ab, ac;
        float area() const { return 0.5f * glm::length(glm::cross(ab, ac)); }
    };
    struct Triangle {
        glm::vec3 a, b, c;
    };
    glm::vec3 corner(std::uint32_t triangle, std::size_t number) const;
    Corners corners(std::uint32_t triangle) const;
    static Triangle corners_of(const Corners& c, const Patch& patch);
    bool is_culled(const Triangle& t) const;
    float min_ideal_area(const Triangle& t) const;
    std::uint32_t splits(const Corners& c, const Patch& patch, bool is_first_round) const;
    std::uint32_t units(const Corners& c, const Patch& patch) const;
    template <class To>
    void split(const Corners& c, const Patch& whole, bool is_first_round, const To& to) const;

    const scene::World& world_;
    Ideal ideal_;
    Frustum frustum_;
    unsigned seed_;
};

}  // namespace ir::methods::deep_screen_space
