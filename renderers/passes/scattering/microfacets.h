#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

#include "shaders/lib/brdf.glsl.h"

/// The functions of shaders/lib/brdf.glsl on the host, and what sampling them needs. Directions are unit
/// vectors; `_ts` ones are in a frame whose z is the normal.
namespace ir::passes {

/// Halfway between l and v; the normal where they are opposite, and nothing is halfway.
inline glm::vec3 half_vector(glm::vec3 n, glm::vec3 l, glm::vec3 v) {
    const auto sum = l + v;
    const float size = glm::length(sum);
    return size > 0 ? sum / size : n;
}

/// [Walter07 eq. 33]
inline float ggx_distribution(float n_dot_h, float alpha) {
    const float squared = alpha * alpha;
    const float denominator = n_dot_h * n_dot_h * (squared - 1) + 1;
    return squared / (glm::pi<float>() * denominator * denominator);
}

/// From the squared sine between normal and half vector: near the peak its cosine has lost the digits that
/// count, 10 % of the value at α = 1e-3.  [Walter07 eq. 33, (n·h)² (α² - 1) + 1 = α² + (1 - α²) sin²]
inline float ggx_distribution_of_sine(float squared_sine, float alpha) {
    const float squared = alpha * alpha;
    const float denominator = squared + (1 - squared) * squared_sine;
    return squared / (glm::pi<float>() * denominator * denominator);
}

/// ∫ f cosθ of GGX microfacets over the directions.
inline glm::vec3 directional_albedo(const glm::vec3& f0, float roughness, float cosine) {
    const glm::vec3 powers(1, cosine, cosine * cosine);
    const float squared = roughness * roughness;
    const float lost = glm::dot(powers, glm::vec3(2.288f, -5.423f, 2.189f)) +
                       roughness * glm::dot(powers, glm::vec3(-5.015f, 16.649f, -8.123f)) +
                       squared * glm::dot(powers, glm::vec3(2.892f, -10.219f, 5.447f));
    const float grazing = std::pow(1 - cosine, 5.0f) * std::exp(-5 * squared);
    return f0 * glm::clamp(1 - squared * lost, 0.0f, 1.0f) + (1.0f - f0) * grazing;
}

/// Height-correlated Smith masking and shadowing over 4 (n·l)(n·v).  [Heitz14 eq. 99]
inline float smith_visibility(float n_dot_l, float n_dot_v, float alpha) {
    const float squared = alpha * alpha;
    const float towards_viewer = n_dot_l * std::sqrt(n_dot_v * n_dot_v * (1 - squared) + squared);
    const float towards_light = n_dot_v * std::sqrt(n_dot_l * n_dot_l * (1 - squared) + squared);
    return 0.5f / std::max(towards_viewer + towards_light, 1e-7f);
}

/// Smith's masking of one direction over 2 n·v: G1 = 2 / (1 + √(1 + α² tan²θ)), θ to the macroscopic normal.
/// [Walter07 eq. 34]
inline float smith_masking_over_2_cosine(float n_dot_v, float alpha) {
    const float squared = alpha * alpha;
    return 1 / (n_dot_v + std::sqrt(squared + (1 - squared) * n_dot_v * n_dot_v));
}

/// [Schlick94 eq. 15]
inline glm::vec3 schlick_fresnel(glm::vec3 f0, float v_dot_h) {
    const float x = std::clamp(1 - v_dot_h, 0.0f, 1.0f), x2 = x * x;
    return f0 + (1.0f - f0) * (x2 * x2 * x);
}

/// Reflectance at normal incidence from air.
inline float dielectric_f0(float ior) {
    const float ratio = (ior - 1) / (ior + 1);
    return ratio * ratio;
}

/// The same of the interface of a layered material.  [glTF2 B.3.5]
inline glm::vec3 layered_f0(float ior, glm::vec3 base_colour, float metallic) {
    return glm::mix(glm::vec3(dielectric_f0(ior)), base_colour, metallic);
}

/// Reflectance of a smooth interface for unpolarised light, (r_s² + r_p²)/2, and the cosine of the refracted
/// ray; 1 and 0 for total internal reflection. `eta`: index behind the interface over that in front of it;
/// an index of 0 reflects everything.  [glTF2 KHR_materials_ior]
struct DielectricFresnel {
    float reflectance, refracted_cosine;
};
inline DielectricFresnel dielectric_fresnel(float cosine, float eta) {
    const float squared_sine = (1 - cosine * cosine) / (eta * eta);  // of the refracted ray, by Snell's law
    if (!(squared_sine < 1)) return {1, 0};
    const float refracted = std::sqrt(1 - squared_sine);
    const float s = (cosine - eta * refracted) / (cosine + eta * refracted);
    const float p = (eta * cosine - refracted) / (eta * cosine + refracted);
    return {(s * s + p * p) / 2, refracted};
}

/// Of a plane-parallel sheet, all reflections between its two interfaces counted: 2F / (1 + F).
inline float sheet_reflectance(float interface_reflectance) {
    return 2 * interface_reflectance / (1 + interface_reflectance);
}

/// Cosine-distributed about z.  [Malley88], by polar coordinates
inline glm::vec3 sample_cosine_ts(glm::vec2 u) {
    const float radius = std::sqrt(u.x), phi = glm::two_pi<float>() * u.y;
    return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(std::max(0.0f, 1 - u.x))};
}

/// A GGX normal as often as `v` (above the surface) sees it, with density G1(v) D(h) max(0, v·h) / v.z.
/// [Heitz18 listing 1]
inline glm::vec3 sample_visible_normal_ts(glm::vec3 v, float alpha, glm::vec2 u) {
    const auto stretched = glm::normalize(glm::vec3(alpha * v.x, alpha * v.y, v.z));
    const float squared = stretched.x * stretched.x + stretched.y * stretched.y;
    const auto first =
        squared > 0 ? glm::vec3(-stretched.y, stretched.x, 0) / std::sqrt(squared) : glm::vec3(1, 0, 0);
    const auto second = glm::cross(stretched, first);
    const float radius = std::sqrt(u.x), phi = glm::two_pi<float>() * u.y;
    const float a = radius * std::cos(phi), side = 0.5f * (1 + stretched.z);
    const float b = (1 - side) * std::sqrt(std::max(0.0f, 1 - a * a)) + side * radius * std::sin(phi);
    const auto h = a * first + b * second + std::sqrt(std::max(0.0f, 1 - a * a - b * b)) * stretched;
    return glm::normalize(glm::vec3(alpha * h.x, alpha * h.y, std::max(0.0f, h.z)));
}

}  // namespace ir::passes
