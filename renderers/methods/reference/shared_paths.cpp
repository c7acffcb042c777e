#include "renderers/methods/reference/shared_paths.h"

#include <cmath>

#include "renderers/methods/reference/path_world.h"
#include "renderers/passes/raytracing/ray_offset.h"
#include "renderers/passes/scattering/microfacets.h"

namespace ir::methods::reference {
namespace {

/// cosθ(from) / cosθ(to) about the geometric normal.
float cosine_ratio(const passes::Surface& surface, glm::vec3 from, glm::vec3 to) {
    const float arriving = std::abs(glm::dot(surface.geometric_normal_ws, from)),
                leaving = std::abs(glm::dot(surface.geometric_normal_ws, to));
    return leaving > 0 ? arriving / leaving : 0;
}

/// The event's factor where the path runs the other way, along `from` on to `to`; 0 where it does not.
float turned(const SharedPaths::Event& event, glm::vec3 from, glm::vec3 to) {
    const float back = event.is_specular ? event.bsdf.specular_spread(from, to)
                                         : event.bsdf.pdf_from_any_side(from, to) / event.pdf;
    return back * cosine_ratio(event.surface, from, to);
}

}  // namespace

float together(float one, float other) {
    return other > 0 ? std::hypot(one, other) : one;
}

bool SharedPaths::follows(const passes::Surface& surface, bool is_specular) const {
    if (is_specular) return true;
    if (!follows_sharp_ || model_ == Transport::Materials::lambert || surface.is_unlit) return false;
    const bool has_interface =
        model_ == Transport::Materials::gltf || surface.metallic > 0 || surface.transmission > 0;
    const float alpha = surface.roughness * surface.roughness;
    return has_interface && alpha >= passes::mirror_alpha && alpha < sharp_alpha;
}

float SharedPaths::at_eye(glm::vec3 position_ws) const {
    const auto seen = film_.see(position_ws);
    return seen ? static_cast<float>(film_.pixels()) / seen->importance : 0;
}

void SharedPaths::add(FromCamera& path, const Event& event, bool is_first) const {
    if (!(path.ratio > 0)) return;
    if (is_first) {
        // From light it is connected to the eye, which has no density; a mirror can not be.
        path.ratio *=
            event.is_specular ? 0 : cosine_ratio(event.surface, event.to_light, event.to_eye) / event.pdf;
        return;
    }
    path.ratio *= turned(event, event.to_light, event.to_eye);
    path.is_followed = follows(event.surface, event.is_specular);
}

float SharedPaths::met(const FromCamera& path, int emitter, std::uint32_t triangle, glm::vec3 direction_ws,
                       float distance) const {
    if (!path.is_followed || !(path.ratio > 0)) return 0;
    return path.ratio * emission_.density(emitter, triangle, -direction_ws, distance);
}

float SharedPaths::chosen(const FromCamera& path, const passes::Surface& surface, const passes::Bsdf& bsdf,
                          glm::vec3 to_eye, const passes::LightSample& light) const {
    if (!(path.ratio > 0) || !follows(surface, false)) return 0;
    const auto to_light = light.direction_ws;
    return path.ratio * bsdf.pdf_from_any_side(to_light, to_eye) * cosine_ratio(surface, to_light, to_eye) *
           emission_.density(light.emitter, light.triangle, -to_light, light.distance);
}

bool SharedPaths::add_first(FromLight& path, const Event& event, const passes::EmittedLight& source,
                            float distance) const {
    if (!follows(event.surface, event.is_specular)) return false;
    path.ratio = 1 / source.density(distance);
    path.is_first_specular = event.is_specular;
    if (event.is_specular) return add(path, event);
    // The density back depends on how the source is found.
    path.ratio *= cosine_ratio(event.surface, event.to_eye, event.to_light) / event.pdf;
    path.first_pdf = event.bsdf.pdf_from_any_side(event.to_eye, event.to_light);
    path.first_normal = event.bsdf.scatters_through() ? glm::vec3(0) : event.surface.geometric_normal_ws;
    path.first_origin = passes::offset_origin(event.surface.position_ws, path.first_normal);
    return true;
}

bool SharedPaths::add(FromLight& path, const Event& event) const {
    const float factor = turned(event, event.to_eye, event.to_light);
    path.ratio *= factor;
    return factor > 0 || !event.is_specular;
}

float SharedPaths::connected(const FromLight& path, const passes::Surface& surface, const passes::Bsdf& bsdf,
                             glm::vec3 to_eye, glm::vec3 to_light, const passes::EmittedLight& source,
                             const passes::LightSampler& lights) const {
    const float last = bsdf.pdf_from_any_side(to_eye, to_light) * cosine_ratio(surface, to_eye, to_light);
    const float meets = source.has_extent ? path.first_pdf : 0;
    const float chooses =
        path.is_first_specular ? 0 : lights.pdf_of_arrival(path.first_origin, path.first_normal, source);
    return path.ratio * last / at_eye(surface.position_ws) * together(meets, chooses);
}

}  // namespace ir::methods::reference
