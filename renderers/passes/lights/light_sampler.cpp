#include "renderers/passes/lights/light_sampler.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "renderers/passes/lights/emission_sampler.h"
#include "renderers/passes/lights/environment_light.h"
#include "renderers/passes/lights/flat_light.h"
#include "renderers/passes/lights/light_choice.h"
#include "renderers/passes/lights/punctual.h"
#include "renderers/passes/lights/triangle_lights.h"
#include "renderers/scene/light_sources.h"

namespace ir::passes {
namespace {

/// Numbers of the world's.
std::vector<int> sampled_lights(const scene::World& world, const LightSamplerOptions& options) {
    std::vector<int> numbers;
    for (std::size_t i = 0; i < world.lights.size(); ++i)
        if (scene::is_flat(world.lights[i]) ? options.lamps : options.punctual)
            numbers.push_back(static_cast<int>(i));
    return numbers;
}

/// `choice` with more than its 24 bits, which would not last to the leaves of a deep tree: the rest are a
/// hash of all the numbers given.
double lengthened(float choice, glm::vec2 u) {
    auto bits = (std::uint64_t{std::bit_cast<std::uint32_t>(u.x)} << 32 | std::bit_cast<std::uint32_t>(u.y)) ^
                std::bit_cast<std::uint32_t>(choice) * std::uint64_t{0x9e3779b97f4a7c15};
    bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9;  // [Steele14, the finaliser of SplitMix]
    bits = (bits ^ bits >> 27) * 0x94d049bb133111eb;
    constexpr double unit = 0x1p-24, below_one = 1 - 0x1p-53;
    return std::min(choice + unit * (static_cast<double>(bits >> 32) * 0x1p-32), below_one);
}

}  // namespace

struct LightSampler::Impl {
    Impl(const SurfaceLookup& surfaces, const Options& options);
    std::optional<LightSample> sample_light(std::size_t light, float probability, glm::vec3 position_ws,
                                            glm::vec2 u) const;
    std::optional<LightSample> sample_triangle(std::size_t triangle, float probability, glm::vec3 position_ws,
                                               glm::vec2 u) const;
    std::optional<LightSample> sample_environment(float probability, glm::vec3 normal_ws, glm::vec2 u) const;

    struct Flat {
        FlatLight light;
        int index;  ///< of lights
    };
    std::vector<int> numbers;  ///< of lights in the world
    std::vector<scene::Light> lights;
    std::vector<Flat> flat;
    std::vector<int> flat_of;  ///< per light: index into flat or -1
    std::optional<TriangleLights> triangles;
    std::optional<EnvironmentLight> environment;
    std::optional<LightChoice> choice;
};

LightSampler::Impl::Impl(const SurfaceLookup& surfaces, const Options& options)
    : numbers(sampled_lights(surfaces.world(), options)) {
    for (const int i : numbers) lights.push_back(surfaces.world().lights[static_cast<std::size_t>(i)]);
    flat_of.assign(lights.size(), -1);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (!scene::is_flat(lights[i])) continue;
        flat_of[i] = static_cast<int>(flat.size());
        flat.push_back({FlatLight(lights[i]), static_cast<int>(i)});
    }
    if (options.emissive_meshes) triangles.emplace(surfaces);
    if (options.environment) environment.emplace(surfaces.scene().environment);
    constexpr float min_radius = 1e-3f;  // a scene of one point has room for light, too
    choice.emplace(lights, triangles ? &*triangles : nullptr,
                   environment ? environment->mean_luminance() : 0.0f,
                   std::max(surfaces.world().bounds.radius(), min_radius));
}

std::optional<LightSample> LightSampler::Impl::sample_light(std::size_t light, float probability,
                                                            glm::vec3 position_ws, glm::vec2 u) const {
    if (const int number = flat_of[light]; number >= 0) {
        const auto& shape = flat[static_cast<std::size_t>(number)].light;
        const auto point = shape.sample(position_ws, u);
        if (!point) return std::nullopt;
        return LightSample{point->direction_ws,      point->distance, shape.radiance(),
                           probability * point->pdf, false,           numbers[light]};
    }
    const auto arrival = punctual_arrival(lights[light], position_ws);
    if (!arrival) return std::nullopt;
    return LightSample{arrival->direction_ws, arrival->distance, arrival->irradiance, probability, true,
                       numbers[light]};
}

std::optional<LightSample> LightSampler::Impl::sample_triangle(std::size_t triangle, float probability,
                                                               glm::vec3 position_ws, glm::vec2 u) const {
    const auto point = triangles->sample(triangle, position_ws, u);
    if (!point) return std::nullopt;
    return LightSample{point->direction_ws,         point->distance, point->radiance,
                       probability * point->pdf,    false,           EmissionSampler::emissive_mesh,
                       (*triangles)[triangle].index};
}

std::optional<LightSample> LightSampler::Impl::sample_environment(float probability, glm::vec3 normal_ws,
                                                                  glm::vec2 u) const {
    const auto sky = environment->sample(normal_ws, u);
    if (!(sky.pdf > 0) || sky.radiance == glm::vec3(0)) return std::nullopt;
    return LightSample{sky.direction_ws,
                       std::numeric_limits<float>::infinity(),
                       sky.radiance,
                       probability * sky.pdf,
                       false,
                       EmissionSampler::environment};
}

LightSampler::LightSampler(const SurfaceLookup& surfaces, const Options& options)
    : impl_(std::make_unique<Impl>(surfaces, options)) {}

LightSampler::~LightSampler() = default;

bool LightSampler::empty() const {
    return impl_->choice->empty();
}

std::optional<LightSample> LightSampler::sample(LightReceiver& receiver, float choice, glm::vec2 u) const {
    const auto chosen = impl_->choice->choose(receiver, lengthened(choice, u));
    if (!chosen) return std::nullopt;
    if (chosen->emitter == LightChoice::environment)
        return impl_->sample_environment(chosen->probability, receiver.normal_ws, u);
    const auto emitter = static_cast<std::size_t>(chosen->emitter), lights = impl_->lights.size();
    return emitter < lights
               ? impl_->sample_light(emitter, chosen->probability, receiver.position_ws, u)
               : impl_->sample_triangle(emitter - lights, chosen->probability, receiver.position_ws, u);
}

float LightSampler::pdf_of_triangle(LightReceiver& receiver, const Hit& hit) const {
    if (!impl_->triangles) return 0;
    const int number = impl_->triangles->find(hit.triangle);
    if (number < 0) return 0;
    const int emitter = static_cast<int>(impl_->lights.size()) + number;
    return impl_->choice->probability(receiver, emitter) *
           impl_->triangles->pdf(static_cast<std::size_t>(number), receiver.position_ws, hit.u, hit.v);
}

float LightSampler::pdf_of_light(LightReceiver& receiver, glm::vec3 direction_ws, const LightHit& hit) const {
    const auto light = static_cast<std::size_t>(hit.light);
    if (hit.light < 0 || light >= impl_->lights.size() || impl_->flat_of[light] < 0) return 0;
    const auto& shape = impl_->flat[static_cast<std::size_t>(impl_->flat_of[light])].light;
    return impl_->choice->probability(receiver, hit.light) * shape.pdf(receiver.position_ws, direction_ws);
}

float LightSampler::pdf_of_environment(glm::vec3 normal_ws, glm::vec3 direction_ws) const {
    if (!has_environment()) return 0;
    return impl_->choice->environment_probability(normal_ws) *
           impl_->environment->pdf(normal_ws, direction_ws);
}

float LightSampler::pdf_of_arrival(glm::vec3 position_ws, glm::vec3 normal_ws,
                                   const EmittedLight& light) const {
    LightReceiver receiver(position_ws, normal_ws);
    if (light.emitter == EmissionSampler::environment)
        return pdf_of_environment(normal_ws, -light.direction_ws);
    if (light.emitter == EmissionSampler::emissive_mesh) {
        const int number = impl_->triangles ? impl_->triangles->find(light.triangle) : -1;
        const float cosine = glm::dot(light.normal_ws, light.direction_ws);
        if (number < 0 || !(cosine > 0)) return 0;
        const auto way = position_ws - light.origin_ws;
        return impl_->choice->probability(receiver, static_cast<int>(impl_->lights.size()) + number) *
               light.area_pdf * glm::dot(way, way) / cosine;
    }
    const auto at = std::ranges::find(impl_->numbers, light.emitter) - impl_->numbers.begin();
    if (at >= std::ssize(impl_->numbers)) return 0;
    const float chosen = impl_->choice->probability(receiver, static_cast<int>(at));
    const int number = impl_->flat_of[static_cast<std::size_t>(at)];
    if (number < 0) return chosen;
    return chosen * impl_->flat[static_cast<std::size_t>(number)].light.pdf(position_ws, -light.direction_ws);
}

glm::vec3 LightSampler::environment(glm::vec3 direction_ws) const {
    return impl_->environment ? impl_->environment->radiance(direction_ws) : glm::vec3(0);
}

bool LightSampler::has_environment() const {
    return impl_->environment && !impl_->environment->empty();
}

bool LightSampler::has_emissive_meshes() const {
    return impl_->triangles && impl_->triangles->size() > 0;
}

bool LightSampler::may_meet(glm::vec3 origin_ws, glm::vec3 direction_ws) const {
    if (has_environment()) return true;
    if (has_emissive_meshes() && impl_->choice->may_meet(origin_ws, direction_ws)) return true;
    bool meets_flat = false;
    visit_lights(origin_ws, direction_ws, std::numeric_limits<float>::infinity(),
                 [&](const LightHit&) { meets_flat = true; });
    return meets_flat;
}

const LightChoice& LightSampler::choice() const {
    return *impl_->choice;
}

std::vector<FlatLight> LightSampler::lamps() const {
    std::vector<FlatLight> lamps;
    for (const auto& flat : impl_->flat) lamps.push_back(flat.light);
    return lamps;
}

const TriangleLights* LightSampler::triangles() const {
    return impl_->triangles ? &*impl_->triangles : nullptr;
}

const EnvironmentLight* LightSampler::environment_light() const {
    return impl_->environment ? &*impl_->environment : nullptr;
}

int LightSampler::extended_lights() const {
    return static_cast<int>(impl_->flat.size());
}

std::optional<LightHit> LightSampler::intersect(int index, glm::vec3 origin_ws, glm::vec3 direction_ws,
                                                float far) const {
    const auto& [shape, light] = impl_->flat[static_cast<std::size_t>(index)];
    const auto distance = shape.intersect(origin_ws, direction_ws, far);
    if (!distance) return std::nullopt;
    return LightHit{*distance, shape.radiance(), light, impl_->numbers[static_cast<std::size_t>(light)]};
}

}  // namespace ir::passes
