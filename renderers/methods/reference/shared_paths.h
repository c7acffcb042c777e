#pragma once

#include <glm/glm.hpp>

#include "renderers/core/transport.h"
#include "renderers/methods/reference/film.h"
#include "renderers/passes/lights/emission_sampler.h"
#include "renderers/passes/lights/light_sampler.h"
#include "renderers/passes/scattering/bsdf.h"

namespace ir::methods::reference {

/// Paths that are traced both from the camera and from light. They leave a source, meet a mirror, glass or a
/// sharp surface first, and at last a surface that the eye sees and that scatters. Up to three techniques
/// find them: a path from the camera meets the source; one chooses the source from the sharp surface
/// (next-event estimation); one from the source is connected to the eye. Each counts by the power heuristic.
/// Of their densities per area of all vertices only ratios are kept, to which each vertex adds a factor.
/// Roulette is left out: the weights sum to 1 without it.  [Veach97 §9.2, §10.2]
///
///   from light      density of the source's ray · Π p(to eye) · Π cosθ(to light) / cosθ(to eye) · n
///   ―――――――――――  =  ―――――――――――――――――――――――――――――――――――――――――――――――――――――――――――――――――――――――――――
///   from camera     importance of the pixel · Π p(to light)
///
/// The products are over the surfaces, but p(to eye) without the one that the eye sees, with cosines about
/// geometric normals; n is the number of paths from light for each of a pixel; squared distances cancel.
/// Thread-safe.
class SharedPaths {
  public:
    /// Keeps a reference to the emission. `follows_sharp`: whether sharp surfaces are followed at all.
    SharedPaths(const scene::View& view, const passes::EmissionSampler& emission, Transport::Materials model,
                bool follows_sharp = true)
        : film_(view), emission_(emission), model_(model), follows_sharp_(follows_sharp) {}

    const Film& film() const { return film_; }
    const passes::EmissionSampler& emission() const { return emission_; }
    /// Whether paths from light go on where this is the first surface that they meet.
    bool follows(const passes::Surface& surface, bool is_specular) const;

    /// A path's event at a surface. Directions are unit, away from it; `pdf` as sampled, 0 of specular ones.
    struct Event {
        const passes::Surface& surface;
        const passes::Bsdf& bsdf;
        glm::vec3 to_eye, to_light;
        float pdf;
        bool is_specular;
    };

    /// What a path from the camera knows.
    struct FromCamera {
        float ratio = 0;           ///< from light over from camera, without the source; 0: not from light
        bool is_followed = false;  ///< at the last surface: from light, too, if a source comes next
    };
    /// Begins at the surface that the eye sees: 0 where that is in no pixel.
    float at_eye(glm::vec3 position_ws) const;
    void add(FromCamera& path, const Event& event, bool is_first) const;
    /// From light over from camera where the path meets a source after the last event.
    float met(const FromCamera& path, int emitter, std::uint32_t triangle, glm::vec3 direction_ws,
              float distance) const;
    /// Density of the path from light, in the measure in which the source was chosen at a surface.
    float chosen(const FromCamera& path, const passes::Surface& surface, const passes::Bsdf& bsdf,
                 glm::vec3 to_eye, const passes::LightSample& light) const;

    /// What a path from light knows.
    struct FromLight {
        float ratio = 1;  ///< from camera over from light, without the eye and how the source is found
        glm::vec3 first_origin{0},
            first_normal{0};  ///< the first surface as a path from the camera leaves it
        float first_pdf = 1;  ///< towards the source, 1/sr; 1 of specular events
        bool is_first_specular = false;
    };
    /// False where no path from the camera goes this way, or where it is left to the camera.
    bool add_first(FromLight& path, const Event& event, const passes::EmittedLight& source,
                   float distance) const;
    bool add(FromLight& path, const Event& event) const;
    /// From camera, by both techniques, over from light, where the path is connected to the eye. `lights`: of
    /// next-event estimation.
    float connected(const FromLight& path, const passes::Surface& surface, const passes::Bsdf& bsdf,
                    glm::vec3 to_eye, glm::vec3 to_light, const passes::EmittedLight& source,
                    const passes::LightSampler& lights) const;

  private:
    Film film_;
    const passes::EmissionSampler& emission_;
    Transport::Materials model_;
    bool follows_sharp_;
};

/// Densities of other techniques as one: the power heuristic adds up their squares.
float together(float one, float other);

}  // namespace ir::methods::reference
