#pragma once

#include <optional>
#include <vector>

#include "renderers/methods/reference/path_rules.h"
#include "renderers/methods/reference/path_world.h"
#include "renderers/passes/sampling/point_sequence.h"
#include "renderers/passes/scattering/bsdf.h"
#include "renderers/scene/view.h"

namespace ir::methods::reference {

/// What a view sees of points: the inverse of passes::pixel_rays().
class Film {
  public:
    struct Seen {
        glm::vec3 to_eye_ws{0};  ///< unit
        float distance = 0;      ///< m, to the eye; of orthographic views to its plane
        std::uint32_t pixel = 0;
        /// Density of the pixel's box filter for directions at the eye over the squared distance, 1/m²:
        /// radiance that leaves dA towards the eye adds importance · cosθ · dA to the pixel's mean.
        float importance = 0;
    };
    explicit Film(const scene::View& view);
    std::size_t pixels() const {
        return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    }
    /// Nothing outside the picture and behind the eye.
    std::optional<Seen> see(glm::vec3 position_ws) const;

  private:
    glm::vec3 origin_{0}, axis_{0};
    glm::mat3 film_from_world_{1};
    float pixel_area_ = 1;  ///< m², of orthographic views; of others at depth 1
    int width_ = 0, height_ = 0;
    bool is_orthographic_ = false;
};

/// Light that a path has brought to a pixel, W/(m² sr) times the number of paths.
struct Splat {
    std::uint32_t pixel = 0;
    int scatterings = 0;
    glm::vec3 light{0};
};

/// Traces light from point, spot and directional lights over mirrors and through glass, which no path from
/// the camera finds: such lights are met by no ray, and a path from the camera chooses them only where
/// nothing is in between. The two share no path: what a light sends to its first surface and what that
/// scatters is the camera's, what a mirror or glass sends on first is the light's.  [Veach97 §4.3, §5.3,
/// §10.3]
///
/// A path is seen wherever it is scattered and the eye sees that surface. What is seen of it in a mirror or
/// through glass is found by neither. Its light is spread over the pixel by a box filter. Thread-safe.
class LightTracer {
  public:
    struct Counts {
        std::uint64_t rays = 0, cut = 0;
    };
    LightTracer(const PathWorld& world, const PathRules& rules, const scene::View& view);

    /// Whether there are such paths.
    static bool has_paths(const scene::World& world, const PathRules& rules,
                          const std::vector<bool>& specular);
    const Film& film() const { return film_; }
    /// One path; what it brings is appended.
    void trace(const passes::PathSampler& sampler, std::vector<Splat>& splats, Counts& counts) const;

  private:
    struct Source {
        scene::Light light;
        float probability = 0;
    };
    struct Path {
        passes::PathSampler sampler;
        glm::vec3 origin{0}, direction{0};
        glm::vec3 power{0};  ///< W
        const scene::Light* light = nullptr;
        float from_light = 0;  ///< metres since the light
        float way = 0;         ///< metres since the last scattering, or since the first mirror or glass
        int medium = -1, scatterings = 0, specular_events = 0;
        std::uint32_t events = 0;
    };
    std::optional<Path> emitted(const passes::PathSampler& sampler) const;
    bool arrive(Path& path, std::vector<Splat>& splats, Counts& counts) const;
    void connect(const Path& path, const passes::Surface& surface, const passes::Bsdf& bsdf,
                 std::vector<Splat>& splats, Counts& counts) const;
    bool go_on(Path& path, const passes::Surface& surface, const passes::Bsdf& bsdf, Counts& counts) const;
    int medium_behind(const Path& path, const passes::Surface& surface) const;
    void absorb(Path& path, int material, float distance) const;

    const PathWorld& world_;
    PathRules rules_;
    Film film_;
    std::vector<Source> sources_;
    glm::vec3 centre_ws_{0};
    float radius_ = 0;  ///< of the world
};

}  // namespace ir::methods::reference
