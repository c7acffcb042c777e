#include "renderers/passes/direct/light_estimate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "renderers/passes/raytracing/ray_offset.h"
#include "renderers/passes/scattering/bsdf.h"

namespace ir::passes {
namespace {

/// Pairs of numbers of a sample.
enum LightDimension : std::uint32_t { of_choices, of_source, of_direction };

constexpr float no_limit = std::numeric_limits<float>::infinity();
/// Rays of a pixel start at one point, but go anywhere.
constexpr bool coherent = false;

bool has_finite_parts(glm::vec3 v) {
    return std::isfinite(v.r) && std::isfinite(v.g) && std::isfinite(v.b);
}

}  // namespace

LightEstimate::LightEstimate(const Bvh& bvh, const SurfaceLookup& surfaces, const LightSampler& lights,
                             const Options& options)
    : bvh_(bvh),
      surfaces_(surfaces),
      lights_(lights),
      options_(options),
      panes_(bvh, surfaces, options.between) {}

/// A surface of which samples are taken.
struct LightEstimate::Receiver {
    Bsdf bsdf;
    std::optional<OpaqueLobes> opaque;
    glm::vec3 wo, normal, origin;
    LightReceiver lights;

    Receiver(const Surface& surface, const scene::Material& material, Transport::Materials model,
             glm::vec3 to)
        : bsdf(surface, material, model),
          opaque(bsdf.opaque(to)),
          wo(to),
          normal(surface.geometric_normal_ws),
          origin(offset_origin(surface.position_ws, normal)),
          lights(origin, normal) {}

    /// In the directions whose bit is set.
    void evaluate(std::uint32_t which, const Lanes3& directions, OpaqueLobes::Values& values) const {
        if (opaque) return opaque->evaluate(directions, values);
        for (; which != 0; which &= which - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(which));
            const auto scattered = bsdf.evaluate_with_pdf(wo, directions.at(i));
            values.value.put(i, scattered.value);
            values.pdf[i] = scattered.pdf;
        }
    }

    struct Choice {
        Lanes3 directions;
        std::uint32_t chosen = 0, mirrored = 0;  ///< bits
        Lanes3 of_mirrors;                       ///< weights
    };
    /// Of the first `count`; those that glass lets through are left out.
    void choose(std::size_t count, const Lanes& lobes, const Lanes2& u, Choice& choice) const {
        if (opaque) {
            choice.chosen = opaque->choose(lobes, u, choice.directions) & ((1u << count) - 1);
            return;
        }
        for (std::size_t i = 0; i < count; ++i) {
            const auto one = bsdf.choose(wo, lobes[i], {u.x[i], u.y[i]});
            if (!one || one->is_transmitted) continue;
            choice.chosen |= 1u << i;
            choice.directions.put(i, one->wi);
            if (!one->is_specular) continue;
            choice.mirrored |= 1u << i;
            choice.of_mirrors.put(i, one->weight);
        }
    }
};

/// Rays of samples that wait for their answer, all from one origin.
struct LightEstimate::Pending {
    Bvh::Packet16 rays;
    std::array<std::size_t, lane_count> samples;
    std::array<glm::vec3, lane_count> weights;
    std::array<float, lane_count> pdfs;
    std::size_t count = 0;

    Pending() { std::ranges::fill(rays.active, 0); }
    glm::vec3 direction(std::size_t i) const { return {rays.dx[i], rays.dy[i], rays.dz[i]}; }
    void add(std::size_t sample, glm::vec3 weight, float pdf, glm::vec3 origin, glm::vec3 direction,
             float far) {
        const auto i = count++;
        rays.ox[i] = origin.x, rays.oy[i] = origin.y, rays.oz[i] = origin.z;
        rays.dx[i] = direction.x, rays.dy[i] = direction.y, rays.dz[i] = direction.z;
        rays.near[i] = 0, rays.far[i] = far, rays.active[i] = -1;
        samples[i] = sample, weights[i] = weight, pdfs[i] = pdf;
    }
};

void LightEstimate::sample(const Surface& surface, glm::vec3 wo, std::span<const PathSampler> samplers,
                           std::span<glm::vec3> radiances) const {
    std::ranges::fill(radiances, glm::vec3(0));
    if (surface.is_unlit) return;
    Receiver receiver(surface, surfaces_.material(surface.material), options_.materials, wo);
    for (std::size_t begin = 0; begin < samplers.size(); begin += lane_count) {
        const auto count = std::min(lane_count, samplers.size() - begin);
        const auto some = samplers.subspan(begin, count);
        const auto of_some = radiances.subspan(begin, count);
        Lanes2 choices;
        PathSampler::pairs(some, of_choices, choices);
        if (receiver.bsdf.has_smooth_part()) towards_sources(receiver, some, choices.x, of_some);
        by_directions(receiver, some, choices.y, of_some);
    }
    for (auto& radiance : radiances)
        if (!has_finite_parts(radiance)) radiance = glm::vec3(0);
}

glm::vec3 LightEstimate::reflectance(const Surface& surface) const {
    if (surface.is_unlit) return glm::vec3(0);
    return Bsdf(surface, surfaces_.material(surface.material), options_.materials).albedo();
}

void LightEstimate::towards_sources(Receiver& receiver, std::span<const PathSampler> samplers,
                                    const Lanes& choices, std::span<glm::vec3> radiances) const {
    Lanes2 u;
    PathSampler::pairs(samplers, of_source, u);
    std::array<LightSample, lane_count> lights;
    Lanes3 directions;
    std::uint32_t lit = 0;
    for (std::size_t i = 0; i < samplers.size(); ++i) {
        const auto light = lights_.sample(receiver.lights, choices[i], {u.x[i], u.y[i]});
        if (!light || !(light->pdf > 0)) continue;
        if (glm::dot(receiver.normal, light->direction_ws) <= 0)
            continue;  // rough glass lets nothing through
        lit |= 1u << i;
        lights[i] = *light;
        directions.put(i, light->direction_ws);
    }
    if (lit == 0) return;
    OpaqueLobes::Values scattered;
    receiver.evaluate(lit, directions, scattered);
    Pending pending;
    for (; lit != 0; lit &= lit - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(lit));
        const auto& light = lights[i];
        const auto radiance = scattered.value.at(i) * light.radiance *
                              (options_.combine(light.pdf, scattered.pdf[i]) / light.pdf);
        if (radiance == glm::vec3(0)) continue;
        pending.add(i, radiance, 0, receiver.origin, light.direction_ws, light.distance * shadow_ray_end);
    }
    if (pending.count == 0) return;
    if (!panes_.any()) {
        const auto occluded = bvh_.occluded16(pending.rays, coherent);
        for (std::size_t k = 0; k < pending.count; ++k)
            if ((occluded >> k & 1) == 0) radiances[pending.samples[k]] += pending.weights[k];
        return;
    }
    for (std::size_t k = 0; k < pending.count; ++k) {
        const float far = pending.rays.far[k];
        const auto sight = panes_.look(receiver.origin, pending.direction(k), far);
        if (!sight.end.is_hit()) radiances[pending.samples[k]] += pending.weights[k] * sight.passed(far);
    }
}

void LightEstimate::by_directions(Receiver& receiver, std::span<const PathSampler> samplers,
                                  const Lanes& lobes, std::span<glm::vec3> radiances) const {
    Lanes2 u;
    PathSampler::pairs(samplers, of_direction, u);
    Receiver::Choice choice;
    receiver.choose(samplers.size(), lobes, u, choice);
    // Most directions meet no source, and need neither weight nor ray.
    std::uint32_t meeting = 0;
    for (auto left = options_.mirrors ? choice.chosen : choice.chosen & ~choice.mirrored; left != 0;
         left &= left - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(left));
        if (lights_.may_meet(receiver.origin, choice.directions.at(i))) meeting |= 1u << i;
    }
    if (meeting == 0) return;
    OpaqueLobes::Values scattered;
    receiver.evaluate(meeting & ~choice.mirrored, choice.directions, scattered);
    Pending pending;
    for (; meeting != 0; meeting &= meeting - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(meeting));
        const bool is_mirrored = (choice.mirrored >> i & 1) != 0;
        const float pdf = is_mirrored ? 0 : scattered.pdf[i];
        const auto weight = is_mirrored ? choice.of_mirrors.at(i) : scattered.value.at(i) / pdf;
        if (!is_mirrored && (!(pdf > 0) || weight == glm::vec3(0))) continue;
        pending.add(i, weight, pdf, receiver.origin, choice.directions.at(i), no_limit);
    }
    if (pending.count == 0) return;
    const bool is_clear = !panes_.any();
    Hit hits[lane_count];
    if (is_clear) bvh_.closest_hits16(pending.rays, coherent, hits);
    for (std::size_t k = 0; k < pending.count; ++k) {
        const auto sight =
            is_clear ? Panes::Sight(hits[k]) : panes_.look(receiver.origin, pending.direction(k), no_limit);
        radiances[pending.samples[k]] +=
            pending.weights[k] * met_sources(receiver, pending.direction(k), pending.pdfs[k], sight);
    }
}

/// Sources that a ray meets, each weighted against having been chosen. `pdf` is 0 of a mirror.
glm::vec3 LightEstimate::met_sources(Receiver& receiver, glm::vec3 direction, float pdf,
                                     const Panes::Sight& sight) const {
    const auto weighted = [&](glm::vec3 radiance, float other) {
        return pdf > 0 ? radiance * options_.combine(pdf, other) : radiance;
    };
    const auto& hit = sight.end;
    glm::vec3 sum(0);
    lights_.visit_lights(receiver.origin, direction, hit.distance, [&](const LightHit& light) {
        sum += weighted(sight.passed(light.distance) * light.radiance,
                        lights_.pdf_of_light(receiver.lights, direction, light));
    });
    const auto passed = sight.passed(no_limit);  // from behind all panes
    if (!hit.is_hit()) {
        if (!lights_.has_environment()) return sum;
        return sum + weighted(passed * lights_.environment(direction),
                              lights_.pdf_of_environment(receiver.normal, direction));
    }
    if (!lights_.has_emissive_meshes()) return sum;
    const auto emission = surfaces_.emission(hit.triangle, hit.u, hit.v);
    if (emission == glm::vec3(0)) return sum;
    return sum + weighted(passed * emission, lights_.pdf_of_triangle(receiver.lights, hit));
}

}  // namespace ir::passes
