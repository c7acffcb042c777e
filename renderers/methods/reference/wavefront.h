#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderers/methods/reference/path_rules.h"
#include "renderers/methods/reference/path_world.h"
#include "renderers/methods/reference/shared_paths.h"
#include "renderers/passes/sampling/point_sequence.h"
#include "renderers/passes/scattering/bsdf.h"

namespace ir::methods::reference {

/// A path from the camera: along a ray, or, where the first surface is known, ending there.
struct PathStart {
    passes::PathSampler sampler;
    glm::vec3 origin_ws{0}, direction_ws{0};   ///< direction of unit length
    const passes::Surface* surface = nullptr;  ///< known first surface
    float distance = 0;                        ///< to it; infinite where it is known that there is none
    bool is_known = false;                     ///< no ray has to be traced for the first segment
};

/// Dimensions of a path's sampler: one pair for the pixel, then these for each event.
enum Dimension : std::uint32_t { in_pixel = 0, first_event = 1 };
enum EventDimension : std::uint32_t { towards_light, choices, towards_next, roulette, per_event };

/// What a wavefront did.
struct WavefrontCounts {
    std::uint64_t rays = 0;
    std::uint64_t cut = 0;  ///< paths that ended at max_specular_events
};

/// Traces thousands of paths together, one scattering after another: rays, surfaces, light sources, shadow
/// rays, each as a loop of its own over the paths that are left. Light sources are found both by choosing
/// them and by rays that meet them, combined by multiple importance sampling, also with light tracing where
/// that finds the path, too. A path's result depends on its
/// start alone, never on the others. Keeps its memory from call to call.
class Wavefront {
  public:
    /// `world` and `shared` must outlive it. `shared`: what is also traced from light; null: nothing.
    Wavefront(const PathWorld& world, const PathRules& rules, const Estimator& estimator = {},
              const SharedPaths* shared = nullptr);

    /// Writes the light of each path.
    void trace(std::span<const PathStart> starts, std::span<PathLight> lights);
    const WavefrontCounts& counts() const { return counts_; }

  private:
    struct Path {
        passes::PathSampler sampler;
        glm::vec3 origin, direction;  ///< of the ray under way
        glm::vec3 throughput;         ///< light at the camera over light that arrives along the ray
        glm::vec3 normal;  ///< geometric normal where the ray starts; 0: light comes from both sides
        float pdf;         ///< of the direction, 1/sr; 0: no light source was sampled beside it
        float way;         ///< metres since the last scattering
        SharedPaths::FromCamera shared;
        std::uint32_t index;  ///< of the result
        int medium;           ///< material that the ray runs inside of, or -1
        std::int16_t scatterings, specular_events;
        std::uint32_t dimension(EventDimension which) const {
            const auto events = static_cast<std::uint32_t>(scatterings + specular_events);
            return first_event + events * per_event + which;
        }
    };
    struct ShadowRay {
        glm::vec3 origin, direction, light;
        float far;
        std::uint32_t index;
        int scatterings;
    };

    /// What the ray under way may meet.
    const passes::LightSampler& lights(const Path& path) const {
        return world_.lights.after(path.scatterings);
    }
    void begin(const PathStart& start, std::uint32_t index);
    void intersect();
    void arrive(Path& path, const passes::Hit& hit);
    void arrive_at(Path& path, const passes::Surface& surface, float distance);
    void absorb(Path& path, int material, float distance) const;
    void add_flat_lights(const Path& path, float far);
    void add_environment(const Path& path);
    void add_emission(const Path& path, const passes::Hit& hit);
    /// Weight of light that a ray has met, which sampling light sources finds with this density.
    float weight(const Path& path, float light_pdf, int emitter, std::uint32_t triangle,
                 float distance) const;
    bool is_first(const Path& path) const { return path.scatterings + path.specular_events == 0; }
    void scatter(Path& path, const passes::Surface& surface);
    void go_on(Path& path, const passes::Surface& surface, const passes::BsdfSample& sample,
               const passes::Bsdf& bsdf);
    int medium_behind(const Path& path, const passes::Surface& surface) const;
    void sample_light(const Path& path, const passes::Surface& surface, const passes::Bsdf& bsdf,
                      float choice);
    bool survives(Path& path, std::uint32_t dimension) const;
    void trace_shadow_rays();

    const PathWorld& world_;
    PathRules rules_;
    Estimator estimator_;
    const SharedPaths* shared_;
    int most_;
    WavefrontCounts counts_;
    std::span<PathLight> lights_;
    std::vector<Path> paths_, next_;
    std::vector<passes::Hit> hits_;
    std::vector<ShadowRay> shadow_rays_;
};

}  // namespace ir::methods::reference
