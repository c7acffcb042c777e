#include "renderers/methods/reference/light_tracer.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/constants.h"
#include "renderers/passes/lights/punctual.h"
#include "renderers/passes/raytracing/ray_offset.h"

namespace ir::methods::reference {
namespace {

/// Dimensions of a light path's sampler.
enum EmissionDimension : std::uint32_t { of_emitter, of_place, of_direction, first_arrival };
enum ArrivalDimension : std::uint32_t { lobe_and_roulette, next_direction, per_arrival };

}  // namespace

bool LightTracer::has_paths(const scene::World& world, const PathRules& rules,
                            const SharpMaterials& materials, const passes::EmissionOptions& sources,
                            bool follows_sharp) {
    if (sources.lights.empty() && !sources.environment && !sources.emissive_meshes) return false;
    // A mirror does not scatter, a sharp surface does.
    const int scatterings = rules.max_scatterings();
    const auto& followed = follows_sharp && scatterings > 1 ? materials.sharp : materials.specular;
    return scatterings > 0 && std::any_of(world.ranges.begin(), world.ranges.end(), [&](const auto& range) {
               return range.triangle_count > 0 && followed[static_cast<std::size_t>(range.material)];
           });
}

LightTracer::LightTracer(const PathWorld& world, const PathRules& rules, const SharedPaths& shared,
                         const Estimator& estimator)
    : world_(world), rules_(rules), shared_(shared), estimator_(estimator) {}

void LightTracer::trace(const passes::PathSampler& sampler, std::vector<Splat>& splats,
                        Counts& counts) const {
    auto path = emitted(sampler);
    while (path && arrive(*path, splats, counts)) ++path->events;
}

std::optional<LightTracer::Path> LightTracer::emitted(const passes::PathSampler& sampler) const {
    const auto source = shared_.emission().sample(sampler.pair(of_emitter).x, sampler.pair(of_place),
                                                  sampler.pair(of_direction));
    if (!source || source->flux == glm::vec3(0)) return std::nullopt;
    Path path;
    path.sampler = sampler;
    path.source = *source;
    path.origin = source->origin_ws, path.direction = source->direction_ws;
    path.power = source->flux;
    return path;
}

void LightTracer::absorb(Path& path, int material, float distance) const {
    path.power *= passes::Bsdf::transmittance(world_.material(material), distance);
}

bool LightTracer::arrive(Path& path, std::vector<Splat>& splats, Counts& counts) const {
    const auto hit = world_.bvh.closest_hit(path.origin, path.direction, 0, infinity);
    ++counts.rays;
    if (!hit.is_hit()) return false;
    const bool is_first = path.events == 0;
    if (is_first && !world_.may_be.sharp[static_cast<std::size_t>(world_.material_of(hit))]) return false;
    path.from_light += hit.distance;
    if (!is_first) path.way += hit.distance;
    if (rules_.max_distance > 0 && path.way > rules_.max_distance) return false;
    const auto surface = world_.surfaces.at(hit, path.direction);
    if (surface.is_unlit) return false;
    // Seen from inside without having come in: the light is within the medium.
    const bool is_glass = surface.transmission > 0 && rules_.materials != Transport::Materials::lambert;
    const bool begins_inside = path.medium < 0 && !surface.is_front && is_glass;
    if (path.medium >= 0 || begins_inside)
        absorb(path, begins_inside ? surface.material : path.medium, hit.distance);
    const passes::Bsdf bsdf(surface, world_.material(surface.material), rules_.materials);
    if (!is_first && rules_.count(path.scatterings + 1) && bsdf.has_smooth_part())
        connect(path, surface, bsdf, splats, counts);
    return go_on(path, surface, bsdf, counts);
}

void LightTracer::connect(const Path& path, const passes::Surface& surface, const passes::Bsdf& bsdf,
                          std::vector<Splat>& splats, Counts& counts) const {
    const int scatterings = path.scatterings + 1;
    if (path.source.has_extent && !world_.lights.after(scatterings).has_extent()) return;
    const auto seen = shared_.film().see(surface.position_ws);
    if (!seen) return;
    auto light = path.power * seen->importance * bsdf.evaluate_importance(-path.direction, seen->to_eye_ws);
    if (path.scatterings == 0) light *= passes::range_window(path.source.range, path.from_light);
    if (light == glm::vec3(0)) return;
    const bool is_behind = glm::dot(surface.geometric_normal_ws, seen->to_eye_ws) < 0;
    const int medium = is_behind ? medium_behind(path, surface) : path.medium;
    if (medium >= 0) light *= passes::Bsdf::transmittance(world_.material(medium), seen->distance);
    const auto origin = passes::offset_origin(
        surface.position_ws, is_behind ? -surface.geometric_normal_ws : surface.geometric_normal_ws);
    ++counts.rays;
    if (world_.bvh.occluded(origin, seen->to_eye_ws, 0, seen->distance)) return;
    light *=
        estimator_.combine(1, shared_.connected(path.shared, surface, bsdf, seen->to_eye_ws, -path.direction,
                                                path.source, world_.lights.after(scatterings)));
    splats.push_back({seen->pixel, scatterings, light});
}

int LightTracer::medium_behind(const Path& path, const passes::Surface& surface) const {
    if (!(world_.material(surface.material).thickness > 0)) return path.medium;
    return surface.is_front ? surface.material : -1;
}

bool LightTracer::compare(Path& path, const passes::Surface& surface, const passes::Bsdf& bsdf,
                          const passes::BsdfSample& sample) const {
    const SharedPaths::Event event{surface, bsdf, sample.wi, -path.direction, sample.pdf, sample.is_specular};
    return path.events == 0 ? shared_.add_first(path.shared, event, path.source, path.from_light)
                            : shared_.add(path.shared, event);
}

bool LightTracer::go_on(Path& path, const passes::Surface& surface, const passes::Bsdf& bsdf,
                        Counts& counts) const {
    const auto dimension = first_arrival + path.events * per_arrival;
    const auto numbers = path.sampler.pair(dimension + lobe_and_roulette);
    const auto sample =
        bsdf.sample_importance(-path.direction, numbers.x, path.sampler.pair(dimension + next_direction));
    if (!sample || !compare(path, surface, bsdf, *sample)) return false;
    if (sample->is_specular) {
        if (++path.specular_events > max_specular_events) {
            ++counts.cut;
            return false;
        }
    } else {
        if (path.scatterings == 0) path.power *= passes::range_window(path.source.range, path.from_light);
        if (++path.scatterings >= rules_.max_scatterings()) return false;
        path.way = 0;
        // Weights are reflectances, about; shading normals may make them larger.
        const float survival = Estimator::by_throughput(sample->weight);
        if (!(numbers.y < survival)) return false;
        path.power *= Estimator::compensation(survival);
    }
    path.power *= sample->weight;
    if (sample->is_transmitted) path.medium = medium_behind(path, surface);
    const auto side = sample->is_transmitted ? -surface.geometric_normal_ws : surface.geometric_normal_ws;
    path.origin = passes::offset_origin(surface.position_ws, side);
    path.direction = sample->wi;
    return true;
}

}  // namespace ir::methods::reference
