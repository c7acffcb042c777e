#include "renderers/passes/direct/light_estimate.h"

#include <cmath>
#include <limits>

#include "renderers/passes/raytracing/ray_offset.h"
#include "renderers/passes/scattering/bsdf.h"

namespace ir::passes {
namespace {

/// Pairs of numbers of a sample.
enum LightDimension : std::uint32_t { of_choices, of_source, of_direction };

/// Shadow rays end this fraction before the point on the light, so that they do not meet it.
constexpr float shadow_ray_end = 1 - 1e-4f;
constexpr float no_limit = std::numeric_limits<float>::infinity();

bool has_finite_parts(glm::vec3 v) {
    return std::isfinite(v.r) && std::isfinite(v.g) && std::isfinite(v.b);
}

/// A direction that was drawn, and whether the sources were sampled beside it.
struct DrawnRay {
    glm::vec3 origin, normal, direction;
    float pdf = 0;  ///< 0: of a mirror
};

/// Sources that a ray meets, each weighted against having been chosen.
class MetSources {
  public:
    MetSources(const Panes& panes, const SurfaceLookup& surfaces, const LightSampler& lights,
               float (*combine)(float, float), const DrawnRay& ray)
        : panes_(panes), surfaces_(surfaces), lights_(lights), combine_(combine), ray_(ray) {}

    glm::vec3 radiance() const {
        const auto sight = panes_.look(ray_.origin, ray_.direction, no_limit);
        const auto& hit = sight.end;
        const auto passed = sight.passed(no_limit);  // from behind all panes
        glm::vec3 sum(0);
        lights_.visit_lights(ray_.origin, ray_.direction, hit.distance, [&](const LightHit& light) {
            sum += weighted(sight.passed(light.distance) * light.radiance,
                            lights_.pdf_of_light(ray_.origin, ray_.normal, ray_.direction, light));
        });
        if (!hit.is_hit()) {
            if (!lights_.has_environment()) return sum;
            return sum + weighted(passed * lights_.environment(ray_.direction),
                                  lights_.pdf_of_environment(ray_.origin, ray_.normal, ray_.direction));
        }
        if (!lights_.has_emissive_meshes()) return sum;
        const auto emission = surfaces_.emission(hit.triangle, hit.u, hit.v);
        if (emission == glm::vec3(0)) return sum;
        return sum + weighted(passed * emission,
                              lights_.pdf_of_triangle(ray_.origin, ray_.normal, ray_.direction, hit));
    }

  private:
    glm::vec3 weighted(glm::vec3 radiance, float pdf) const {
        return ray_.pdf > 0 ? radiance * combine_(ray_.pdf, pdf) : radiance;
    }

    const Panes& panes_;
    const SurfaceLookup& surfaces_;
    const LightSampler& lights_;
    float (*combine_)(float, float);
    const DrawnRay& ray_;
};

}  // namespace

LightEstimate::LightEstimate(const Bvh& bvh, const SurfaceLookup& surfaces, const LightSampler& lights,
                             const Options& options)
    : bvh_(bvh),
      surfaces_(surfaces),
      lights_(lights),
      options_(options),
      panes_(bvh, surfaces, options.between) {}

glm::vec3 LightEstimate::sample(const Surface& surface, glm::vec3 wo, const PathSampler& sampler) const {
    if (surface.is_unlit) return glm::vec3(0);
    const Bsdf bsdf(surface, material(surface.material), options_.materials);
    const auto choice = sampler.pair(of_choices);
    glm::vec3 sum(0);
    if (bsdf.has_smooth_part()) sum = towards_source(surface, bsdf, wo, choice.x, sampler.pair(of_source));
    sum += by_direction(surface, bsdf, wo, choice.y, sampler.pair(of_direction));
    return has_finite_parts(sum) ? sum : glm::vec3(0);
}

glm::vec3 LightEstimate::reflectance(const Surface& surface) const {
    if (surface.is_unlit) return glm::vec3(0);
    return Bsdf(surface, material(surface.material), options_.materials).albedo();
}

glm::vec3 LightEstimate::towards_source(const Surface& surface, const Bsdf& bsdf, glm::vec3 wo, float choice,
                                        glm::vec2 u) const {
    const auto normal = surface.geometric_normal_ws;
    const auto origin = offset_origin(surface.position_ws, normal);
    const auto light = lights_.sample(origin, normal, choice, u);
    if (!light || !(light->pdf > 0)) return glm::vec3(0);
    if (glm::dot(normal, light->direction_ws) <= 0) return glm::vec3(0);  // rough glass lets nothing through
    const auto scattered = bsdf.evaluate_with_pdf(wo, light->direction_ws);
    const auto radiance =
        scattered.value * light->radiance * (options_.combine(light->pdf, scattered.pdf) / light->pdf);
    if (radiance == glm::vec3(0)) return radiance;
    const float far = light->distance * shadow_ray_end;
    if (!panes_.any()) return bvh_.occluded(origin, light->direction_ws, 0, far) ? glm::vec3(0) : radiance;
    const auto sight = panes_.look(origin, light->direction_ws, far);
    return sight.end.is_hit() ? glm::vec3(0) : radiance * sight.passed(far);
}

glm::vec3 LightEstimate::by_direction(const Surface& surface, const Bsdf& bsdf, glm::vec3 wo, float lobe,
                                      glm::vec2 u) const {
    const auto chosen = bsdf.choose(wo, lobe, u);
    if (!chosen || chosen->is_transmitted || (chosen->is_specular && !options_.mirrors)) return glm::vec3(0);
    const auto normal = surface.geometric_normal_ws, origin = offset_origin(surface.position_ws, normal);
    // Most directions meet no source, and need neither weight nor ray.
    if (!lights_.may_meet(origin, chosen->wi)) return glm::vec3(0);
    const auto sample = bsdf.weighted(wo, *chosen);
    if (!sample) return glm::vec3(0);
    const DrawnRay ray{origin, normal, sample->wi, sample->pdf};
    return sample->weight * MetSources(panes_, surfaces_, lights_, options_.combine, ray).radiance();
}

}  // namespace ir::passes
