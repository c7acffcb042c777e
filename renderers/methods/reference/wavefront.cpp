#include "renderers/methods/reference/wavefront.h"

#include "renderers/core/constants.h"
#include "renderers/passes/raytracing/ray_offset.h"

namespace ir::methods::reference {

Wavefront::Wavefront(const PathWorld& world, const PathRules& rules, const Estimator& estimator,
                     const SharedPaths* shared)
    : world_(world), rules_(rules), estimator_(estimator), shared_(shared), most_(rules.max_scatterings()) {}

void Wavefront::trace(std::span<const PathStart> starts, std::span<PathLight> lights) {
    lights_ = lights;
    next_.clear(), shadow_rays_.clear();
    for (std::size_t i = 0; i < starts.size(); ++i) {
        lights[i] = {};
        begin(starts[i], static_cast<std::uint32_t>(i));
    }
    trace_shadow_rays();
    while (!next_.empty()) {
        std::swap(paths_, next_);
        next_.clear();
        intersect();
        for (std::size_t i = 0; i < paths_.size(); ++i) arrive(paths_[i], hits_[i]);
        trace_shadow_rays();
    }
}

void Wavefront::begin(const PathStart& start, std::uint32_t index) {
    Path path{};
    path.sampler = start.sampler;
    path.origin = start.origin_ws, path.direction = start.direction_ws, path.normal = -start.direction_ws;
    path.throughput = glm::vec3(1);
    path.index = index;
    path.medium = -1;
    if (!start.is_known) {
        next_.push_back(path);
        return;
    }
    if (rules_.seen) add_flat_lights(path, start.distance);
    if (!start.surface) {
        if (rules_.seen) add_environment(path);
        return;
    }
    if (rules_.seen) lights_[index].seen += start.surface->emission;
    arrive_at(path, *start.surface, start.distance);
}

void Wavefront::intersect() {
    hits_.resize(paths_.size());
    for (std::size_t i = 0; i < paths_.size(); ++i)
        hits_[i] = world_.bvh.closest_hit(paths_[i].origin, paths_[i].direction, 0, infinity);
    counts_.rays += paths_.size();
}

void Wavefront::arrive(Path& path, const passes::Hit& hit) {
    const bool counts = rules_.count(path.scatterings);
    if (counts) add_flat_lights(path, hit.distance);
    if (path.medium >= 0) absorb(path, path.medium, hit.distance);
    if (!hit.is_hit()) {
        if (counts) add_environment(path);
        return;
    }
    const auto material = static_cast<std::size_t>(world_.material_of(hit));
    if (counts && world_.emits[material] && (path.scatterings == 0 || lights(path).has_emissive_meshes()))
        add_emission(path, hit);
    path.way += hit.distance;
    if (rules_.max_distance > 0 && path.scatterings > 0 && path.way > rules_.max_distance) return;
    // After the last scattering only mirrors and glass lead on.
    if (path.scatterings == most_ && most_ > 0 && !world_.may_be.specular[material]) return;
    arrive_at(path, world_.surfaces.at(hit, path.direction), hit.distance);
}

void Wavefront::arrive_at(Path& path, const passes::Surface& surface, float distance) {
    // Seen from inside without having come in: the camera, or a surface, is within the medium.
    const bool is_glass = surface.transmission > 0 && rules_.materials != Transport::Materials::lambert;
    if (path.medium < 0 && !surface.is_front && is_glass) absorb(path, surface.material, distance);
    if (!surface.is_unlit) return scatter(path, surface);
    if (path.scatterings == 0 && rules_.show_unlit())
        lights_[path.index].direct += path.throughput * surface.base_colour;
}

void Wavefront::absorb(Path& path, int material, float distance) const {
    path.throughput *= passes::Bsdf::transmittance(world_.material(material), distance);
}

float Wavefront::weight(const Path& path, float light_pdf, int emitter, std::uint32_t triangle,
                        float distance) const {
    const float traced = shared_ ? shared_->met(path.shared, emitter, triangle, path.direction, distance) : 0;
    if (path.pdf > 0) return estimator_.combine(path.pdf, together(light_pdf, path.pdf * traced));
    return traced > 0 ? estimator_.combine(1, traced) : 1.0f;
}

void Wavefront::add_flat_lights(const Path& path, float far) {
    lights(path).visit_lights(path.origin, path.direction, far, [&](const passes::LightHit& hit) {
        const float pdf =
            path.pdf > 0 ? lights(path).pdf_of_light(path.origin, path.normal, path.direction, hit) : 0;
        auto radiance = weight(path, pdf, hit.emitter, 0, hit.distance) * path.throughput * hit.radiance;
        if (path.medium >= 0)
            radiance *= passes::Bsdf::transmittance(world_.material(path.medium), hit.distance);
        lights_[path.index].after(path.scatterings) += radiance;
    });
}

void Wavefront::add_environment(const Path& path) {
    if (!lights(path).has_environment()) return;
    const float pdf = path.pdf > 0 ? lights(path).pdf_of_environment(path.normal, path.direction) : 0;
    lights_[path.index].after(path.scatterings) +=
        weight(path, pdf, passes::EmissionSampler::environment, 0, infinity) * path.throughput *
        lights(path).environment(path.direction);
}

void Wavefront::add_emission(const Path& path, const passes::Hit& hit) {
    const float pdf = path.pdf > 0 ? lights(path).pdf_of_triangle(path.origin, path.normal, hit) : 0;
    lights_[path.index].after(path.scatterings) +=
        weight(path, pdf, passes::EmissionSampler::emissive_mesh, hit.triangle, hit.distance) *
        path.throughput * world_.surfaces.emission(hit.triangle, hit.u, hit.v);
}

void Wavefront::scatter(Path& path, const passes::Surface& surface) {
    const passes::Bsdf bsdf(surface, world_.material(surface.material), rules_.materials);
    if (shared_ && is_first(path)) path.shared.ratio = shared_->at_eye(surface.position_ws);
    const auto choice = path.sampler.pair(path.dimension(choices));
    if (rules_.count(path.scatterings + 1) && bsdf.has_smooth_part())
        sample_light(path, surface, bsdf, choice.x);
    const auto u = path.sampler.pair(path.dimension(towards_next));
    if (const auto sample = bsdf.sample(-path.direction, choice.y, u)) go_on(path, surface, *sample, bsdf);
}

int Wavefront::medium_behind(const Path& path, const passes::Surface& surface) const {
    if (!(world_.material(surface.material).thickness > 0)) return path.medium;
    return surface.is_front ? surface.material : -1;
}

void Wavefront::go_on(Path& path, const passes::Surface& surface, const passes::BsdfSample& sample,
                      const passes::Bsdf& bsdf) {
    const auto dice = path.dimension(roulette);
    if (shared_)
        shared_->add(path.shared, {surface, bsdf, -path.direction, sample.wi, sample.pdf, sample.is_specular},
                     is_first(path));
    path.throughput *= sample.weight;
    if (sample.is_specular) {
        if (++path.specular_events > max_specular_events) {
            ++counts_.cut;
            return;
        }
    } else {
        if (++path.scatterings > most_) return;
        path.way = 0;
    }
    // After the last scattering only light sources are looked for.
    if (path.scatterings == most_ && !lights(path).has_extent()) return;
    if (!sample.is_specular && !survives(path, dice)) return;
    if (sample.is_transmitted) path.medium = medium_behind(path, surface);
    const auto side = sample.is_transmitted ? -surface.geometric_normal_ws : surface.geometric_normal_ws;
    path.origin = passes::offset_origin(surface.position_ws, side);
    path.direction = sample.wi;
    path.normal = bsdf.scatters_through() ? glm::vec3(0) : surface.geometric_normal_ws;
    path.pdf = sample.pdf;
    next_.push_back(path);
}

bool Wavefront::survives(Path& path, std::uint32_t dimension) const {
    const float probability = estimator_.survival(path.throughput);
    if (probability < 1) {
        if (!(path.sampler.pair(dimension).x < probability)) return false;
        path.throughput *= estimator_.compensate(probability);
    }
    return true;
}

void Wavefront::sample_light(const Path& path, const passes::Surface& surface, const passes::Bsdf& bsdf,
                             float choice) {
    // Rough glass is lit from both sides.
    const auto normal = bsdf.scatters_through() ? glm::vec3(0) : surface.geometric_normal_ws;
    auto origin = passes::offset_origin(surface.position_ws, normal);
    const auto u = path.sampler.pair(path.dimension(towards_light));
    const auto light = world_.lights.after(path.scatterings + 1).sample(origin, normal, choice, u);
    if (!light || !(light->pdf > 0)) return;
    const auto scattered = bsdf.evaluate_with_pdf(-path.direction, light->direction_ws);
    auto radiance = path.throughput * scattered.value * light->radiance / light->pdf;
    if (radiance == glm::vec3(0)) return;
    const float met = light->is_delta ? 0 : scattered.pdf;
    const float traced =
        shared_ && !is_first(path) ? shared_->chosen(path.shared, surface, bsdf, -path.direction, *light) : 0;
    if (const float others = together(met, traced); others > 0)
        radiance *= estimator_.combine(light->pdf, others);
    const bool is_behind = glm::dot(surface.geometric_normal_ws, light->direction_ws) < 0;
    const int medium = is_behind ? medium_behind(path, surface) : path.medium;
    if (medium >= 0) radiance *= passes::Bsdf::transmittance(world_.material(medium), light->distance);
    if (bsdf.scatters_through())
        origin = passes::offset_origin(
            surface.position_ws, is_behind ? -surface.geometric_normal_ws : surface.geometric_normal_ws);
    shadow_rays_.push_back({origin, light->direction_ws, radiance, light->distance * passes::shadow_ray_end,
                            path.index, path.scatterings + 1});
}

void Wavefront::trace_shadow_rays() {
    for (const auto& ray : shadow_rays_) {
        if (!world_.bvh.occluded(ray.origin, ray.direction, 0, ray.far))
            lights_[ray.index].after(ray.scatterings) += ray.light;
    }
    counts_.rays += shadow_rays_.size();
    shadow_rays_.clear();
}

}  // namespace ir::methods::reference
