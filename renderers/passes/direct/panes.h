#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "renderers/core/transport.h"
#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/raytracing/ray_offset.h"
#include "renderers/passes/surface/surface.h"

namespace ir::passes {

/// Sheets of clear glass between a surface and a source, through which light passes straight on
/// (Bsdf::passed_straight()). Keeps references. Thread-safe.
class Panes {
  public:
    Panes(const Bvh& bvh, const SurfaceLookup& surfaces, Transport::Materials model);

    /// Whether there may be any.
    bool any() const { return any_; }
    /// Textures only lower what makes a material one.
    static bool may_be(const scene::Material& material);
    static bool any_in(std::span<const scene::Material> materials, Transport::Materials model);

    /// A ray as far as it goes. The pane behind max_panes ends it.
    class Sight {
      public:
        Sight() = default;
        /// Past no pane.
        explicit Sight(const Hit& hit) : end(hit) {}
        Hit end;  ///< what it ends at, with the distance from the origin
        /// Fraction of the light from this distance that comes to the origin.
        glm::vec3 passed(float distance) const;

      private:
        friend class Panes;
        struct Pane {
            float distance;
            glm::vec3 passed;
        };
        std::array<Pane, max_panes> panes_;
        std::size_t count_ = 0;
    };
    Sight look(glm::vec3 origin, glm::vec3 direction, float far) const;

  private:
    /// Fraction that passes straight on; 0 where it is no pane.
    glm::vec3 passed(const Surface& surface, glm::vec3 direction) const;

    const Bvh& bvh_;
    const SurfaceLookup& surfaces_;
    Transport::Materials model_;
    bool any_;
};

}  // namespace ir::passes
