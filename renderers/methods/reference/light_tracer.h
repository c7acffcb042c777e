#pragma once

#include <optional>
#include <vector>

#include "renderers/methods/reference/path_rules.h"
#include "renderers/methods/reference/path_world.h"
#include "renderers/methods/reference/shared_paths.h"
#include "renderers/passes/sampling/point_sequence.h"
#include "renderers/passes/scattering/bsdf.h"

namespace ir::methods::reference {

/// Light that a path has brought to a pixel, W/(m² sr) times the number of paths.
struct Splat {
    std::uint32_t pixel = 0;
    int scatterings = 0;
    glm::vec3 light{0};
};

/// Traces light over mirrors, through glass and over sharp surfaces: paths that the camera finds by chance
/// alone, or, of lights without extent over mirrors and glass, not at all. Where the first surface is no such
/// (SharedPaths::follows()), the path is the camera's. What both find is weighted by multiple importance
/// sampling.  [Veach97 §4.3, §5.3, §10.3]
///
/// A path is seen wherever it is scattered behind that surface and the eye sees where. What is seen of it in
/// a mirror or through glass is not found. Its light is spread over the pixel by a box filter. Thread-safe.
class LightTracer {
  public:
    struct Counts {
        std::uint64_t rays = 0, cut = 0;
    };
    /// Keeps references.
    LightTracer(const PathWorld& world, const PathRules& rules, const SharedPaths& shared,
                const Estimator& estimator = {});

    /// Whether there are such paths.
    static bool has_paths(const scene::World& world, const PathRules& rules, const SharpMaterials& materials,
                          const passes::EmissionOptions& sources, bool follows_sharp);
    const Film& film() const { return shared_.film(); }
    /// One path; what it brings is appended.
    void trace(const passes::PathSampler& sampler, std::vector<Splat>& splats, Counts& counts) const;

  private:
    struct Path {
        passes::PathSampler sampler;
        passes::EmittedLight source;
        glm::vec3 origin{0}, direction{0};
        glm::vec3 power{0};    ///< W
        float from_light = 0;  ///< metres since the light
        float way = 0;         ///< metres since the last scattering, or since the first mirror or glass
        int medium = -1, scatterings = 0, specular_events = 0;
        std::uint32_t events = 0;
        SharedPaths::FromLight shared;
    };
    std::optional<Path> emitted(const passes::PathSampler& sampler) const;
    bool arrive(Path& path, std::vector<Splat>& splats, Counts& counts) const;
    void connect(const Path& path, const passes::Surface& surface, const passes::Bsdf& bsdf,
                 std::vector<Splat>& splats, Counts& counts) const;
    bool go_on(Path& path, const passes::Surface& surface, const passes::Bsdf& bsdf, Counts& counts) const;
    /// What the event adds to the weight; false where the path is the camera's alone.
    bool compare(Path& path, const passes::Surface& surface, const passes::Bsdf& bsdf,
                 const passes::BsdfSample& sample) const;
    int medium_behind(const Path& path, const passes::Surface& surface) const;
    void absorb(Path& path, int material, float distance) const;

    const PathWorld& world_;
    PathRules rules_;
    const SharedPaths& shared_;
    Estimator estimator_;
};

}  // namespace ir::methods::reference
