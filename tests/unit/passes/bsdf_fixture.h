#pragma once

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <random>

#include "renderers/passes/scattering/bsdf.h"
#include "renderers/scene/frame.h"

namespace ir::test {

using Materials = Transport::Materials;

/// What a Bsdf is made from, with a normal along no axis.
struct Patch {
    passes::Surface surface;
    scene::Material material;
    Materials model = Materials::gltf;

    explicit Patch(Materials m = Materials::gltf) : model(m) {
        const auto n = glm::normalize(glm::vec3(0.3f, -0.5f, -0.8f));
        surface.geometric_normal_ws = surface.shading_normal_ws = n;
        surface.base_colour = {0.8f, 0.5f, 0.3f};
    }
    passes::Bsdf bsdf() const { return {surface, material, model}; }

    /// Columns: tangent, bitangent, shading normal.
    glm::mat3 frame() const {
        const auto n = surface.shading_normal_ws, t = scene::any_tangent(n);
        return {t, glm::cross(n, t), n};
    }
    /// The direction with this cosine to the shading normal.
    glm::vec3 direction(float cosine, float phi = 0.4f) const {
        const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
        return frame() * glm::vec3(sine * std::cos(phi), sine * std::sin(phi), cosine);
    }
};

/// Glass of index 1.5, seen from outside.
inline Patch glass(float thickness, float transmission = 1) {
    Patch patch;
    patch.surface.transmission = transmission;
    patch.surface.metallic = 0;
    patch.surface.roughness = 0;
    patch.surface.base_colour = {0.9f, 0.7f, 0.5f};
    patch.material.thickness = thickness;
    return patch;
}

inline glm::vec3 random_hemisphere(const Patch& patch, std::mt19937& random) {
    std::uniform_real_distribution<float> unit(0, 1);
    return patch.direction(unit(random), glm::two_pi<float>() * unit(random));
}

/// ∫ over the upper hemisphere of the shading normal, by midpoints of equal steps in the polar angle and in
/// azimuth: 1e-3 for α ≥ 0.05.
inline double integrate_hemisphere(const Patch& patch, const std::function<double(glm::vec3)>& f,
                                   int steps = 300) {
    const auto frame = glm::dmat3(patch.frame());
    const double step = glm::half_pi<double>() / steps;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double theta = (i + 0.5) * step, z = std::cos(theta), r = std::sin(theta);
        for (int j = 0; j < 2 * steps; ++j) {
            const double phi = (j + 0.5) * 2 * step;
            sum += r * f(glm::vec3(frame * glm::dvec3(r * std::cos(phi), r * std::sin(phi), z)));
        }
    }
    return sum * step * 2 * step;
}

inline double mean(glm::vec3 c) {
    return (double{c.x} + c.y + c.z) / 3;
}

/// Directional albedo of the smooth part, the mean of the channels.
inline double directional_albedo(const Patch& patch, glm::vec3 wo) {
    const auto bsdf = patch.bsdf();
    return integrate_hemisphere(patch, [&](glm::vec3 wi) { return mean(bsdf.evaluate(wo, wi)); });
}

}  // namespace ir::test
