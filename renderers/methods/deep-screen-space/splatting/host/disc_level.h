#pragma once

#include <embree3/rtcore.h>

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "renderers/methods/deep-screen-space/splatting/host/splat_rules.h"
#include "renderers/methods/deep-screen-space/splatting/host/what_is_seen.h"

namespace ir::methods::deep_screen_space {

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
    /// Only of surfels that may reach what is seen. `cell_of` gives the sub-image of a surfel.
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
