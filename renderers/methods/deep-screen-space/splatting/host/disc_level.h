#pragma once

#include <embree3/rtcore.h>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "renderers/methods/deep-screen-space/splatting/host/splat_rules.h"
#include "renderers/methods/deep-screen-space/surfels/view.h"

namespace ir::methods::deep_screen_space {
/// Where the surfaces of the picture are: what reaches none of them is no use.
class WhatIsSeen {
  public:
    /// `positions`: of the G-buffer, w 0 where nothing is.
    WhatIsSeen(const scene::View& view, std::span<const glm::vec4> positions, const Parameters& parameters)
        : frustum_(frustum(view, 0, parameters)) {
        for (const auto& position : positions) {
            if (position.w == 0) continue;
            least_ = glm::min(least_, glm::vec3(position));
            most_ = glm::max(most_, glm::vec3(position));
        }
    }

    /// False where no surface lies in the sphere.
    bool may_be_reached(glm::vec3 centre_ws, float radius) const {
        const auto gap = glm::max(glm::max(least_ - centre_ws, centre_ws - most_), glm::vec3(0));
        if (!(glm::dot(gap, gap) <= 1.0001f * radius * radius)) return false;
        for (const auto& plane : frustum_.frustum)
            if (glm::dot(glm::vec3(plane), centre_ws) + plane.w < -radius - frustum_.margin) return false;
        return true;
    }

  private:
    Frustum frustum_;
    glm::vec3 least_ = glm::vec3(std::numeric_limits<float>::infinity()), most_ = -least_;
};

/// A ray on one level, and the nearest disc on its way that counts.
struct DiscRay {
    DiscRay(const Receiver& from, glm::vec3 direction) : receiver(from), direction_ws(direction) {
        rtcInitIntersectContext(&context);
    }
    RTCIntersectContext context;  ///< first, as Embree hands it on
    const Receiver& receiver;
    glm::vec3 direction_ws;
    float known = 0;                         ///< m: up to which no disc counts
    float z = 2;                             ///< only discs below it count; then of the nearest
    std::uint32_t winner = 0;                ///< 1 + surfel of the nearest; 0: none
    const class DiscLevel* level = nullptr;  ///< that is being queried
};

/// The discs of one level of the hierarchical framebuffer for one sample: those of its 4^level sub-images
/// stand side by side, each in a cell of its own, in one ray-tracing scene. Thread-safe for queries.
class DiscLevel {
  public:
    /// Only of surfels that may reach what is seen. `cell_of` gives the sub-image of a surfel, for any
    /// thread.
    DiscLevel(RTCDevice device, std::span<const Surfel> surfels, const VisibleLevel& rules, int level,
              const WhatIsSeen& seen, const std::function<std::uint32_t(const Surfel&)>& cell_of);

    /// Looks for discs of a sub-image with hits in (near, far).
    void query(DiscRay& ray, std::uint32_t cell, float near, float far) const;

  private:
    static void filter(const RTCFilterFunctionNArguments* arguments);
    bool take(DiscRay& ray, std::uint32_t primitive) const;
    struct Release {
        void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    };
    struct Run;
    Run run(std::size_t first, std::size_t end, const WhatIsSeen& seen) const;
    void place_cells(glm::vec3 low, glm::vec3 high);
    glm::vec3 offset(std::uint32_t cell) const;
    float exit(const DiscRay& ray) const;
    void build(RTCDevice device, const std::function<std::uint32_t(const Surfel&)>& cell_of);

    std::span<const Surfel> surfels_;
    VisibleLevel rules_;
    int level_;
    std::vector<std::uint32_t> surfel_of_;  ///< of each primitive
    glm::vec3 low_{0}, high_{0};            ///< of all discs
    glm::vec3 cell_{0};                     ///< m, from one sub-image's discs to the next one's
    glm::uvec3 shifts_{0};                  ///< there are 2^ so many cells along each axis
    float rounding_ = 0;                    ///< m, of coordinates in the scene
    std::unique_ptr<std::remove_pointer_t<RTCScene>, Release> scene_;
};

}  // namespace ir::methods::deep_screen_space
