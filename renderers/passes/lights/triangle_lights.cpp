#include "renderers/passes/lights/triangle_lights.h"

#include <algorithm>
#include <cmath>

#include "renderers/passes/lights/luminance.h"

namespace ir::passes {
namespace {

/// Part of the material's emission that a triangle is credited with where its texture looks dark: points may
/// have fallen beside what shines.
constexpr float min_part = 1e-3f;

/// Barycentric coordinates uniform in area: the unit square's lower half is folded onto its upper half along
/// the diagonal, which keeps neighbours together.  [Heitz19]
glm::vec2 low_distortion_map(glm::vec2 u) {
    return u.y > u.x ? glm::vec2(0.5f * u.x, u.y - 0.5f * u.x) : glm::vec2(u.x - 0.5f * u.y, 0.5f * u.y);
}

/// Emission of a material without texture is the same everywhere; of one with it is averaged over as many
/// points as the triangle covers texels, within bounds.
int points_for(const scene::Scene& scene, const scene::World& world, std::uint32_t triangle) {
    constexpr float fewest = 4, most = 256;
    const auto& slot = scene.materials[world.triangle_materials[triangle]].emission_texture;
    if (slot.texture < 0) return 1;
    const auto& texture = scene.textures[static_cast<std::size_t>(slot.texture)];
    const auto& uvs = slot.uv_set == 1 ? world.uv1 : world.uv0;
    glm::vec2 at[3]{};
    for (std::size_t c = 0; c < 3; ++c) {
        const auto vertex = world.indices[3 * triangle + c];
        if (vertex < uvs.size()) at[c] = scene::transformed_uv(slot, uvs[vertex]);
    }
    const glm::vec2 texels(texture.width, texture.height);
    const glm::vec2 a = texels * (at[1] - at[0]), b = texels * (at[2] - at[0]);
    const float covered = 0.5f * std::abs(a.x * b.y - a.y * b.x);
    return static_cast<int>(covered > fewest ? std::min(covered, most) : fewest);
}

/// Of a point at `offset`: distance² / (cos * area), the cosine taken from the normal of length 2 * area.
float pdf_at(const TriangleLights::Triangle& t, glm::vec3 offset, float squared, float distance) {
    const float density = 2 * squared * distance / std::abs(glm::dot(offset, t.cross));
    return std::isfinite(density) ? density : 0;
}

/// Luminance averaged over points of the R2 sequence.  [Roberts18]
float mean_luminance(const SurfaceLookup& surfaces, std::uint32_t triangle, int points) {
    double sum = 0;
    for (int i = 0; i < points; ++i) {
        const auto n = static_cast<double>(i) + 0.5;
        const double x = n * 0.7548776662466927, y = n * 0.5698402909980532;
        const auto at = low_distortion_map({x - std::floor(x), y - std::floor(y)});
        sum += std::max(luminance(surfaces.emission(triangle, at.x, at.y)), 0.0f);
    }
    return static_cast<float>(sum / points);
}

}  // namespace

TriangleLights::TriangleLights(const SurfaceLookup& surfaces)
    : surfaces_(&surfaces), opaque_triangles_(surfaces.world().opaque_triangles) {
    const auto& scene = surfaces.scene();
    const auto& world = surfaces.world();
    for (std::uint32_t i = 0; i < world.triangles(); ++i) {
        const float factor = luminance(scene.materials[world.triangle_materials[i]].emission);
        if (!(factor > 0)) continue;
        const auto corner = [&](std::uint32_t c) { return world.positions[world.indices[3 * i + c]]; };
        Triangle t{corner(0), corner(1) - corner(0), corner(2) - corner(0), i};
        t.cross = glm::cross(t.edge_u, t.edge_v);
        t.area = 0.5f * glm::length(t.cross);
        if (!(t.area > 0) || !std::isfinite(t.area)) continue;
        t.radiance = std::max(mean_luminance(surfaces, i, points_for(scene, world, i)), min_part * factor);
        t.is_even = i < opaque_triangles_ &&
                    scene.materials[world.triangle_materials[i]].emission_texture.texture < 0;
        t.emission = surfaces.emission(i, 0, 0);
        triangles_.push_back(t);
    }
    if (triangles_.empty()) return;
    numbers_.assign(world.triangles(), -1);
    for (std::size_t i = 0; i < triangles_.size(); ++i) numbers_[triangles_[i].index] = static_cast<int>(i);
    if (triangles_.back().index >= opaque_triangles_) masks_.emplace(scene, world);
}

std::optional<TriangleLights::Origin> TriangleLights::origin(std::size_t i, glm::vec2 u) const {
    const auto& t = triangles_[i];
    const auto at = low_distortion_map(u);
    const auto position_ws = t.corner + at.x * t.edge_u + at.y * t.edge_v;
    if (t.is_even) return Origin{position_ws, at, t.emission};
    if (t.index >= opaque_triangles_ && !masks_->is_covered(t.index - opaque_triangles_, at.x, at.y))
        return std::nullopt;
    const Origin origin{position_ws, at, surfaces_->emission(t.index, at.x, at.y)};
    if (origin.radiance == glm::vec3(0)) return std::nullopt;
    return origin;
}

std::optional<TriangleLights::Point> TriangleLights::sample(std::size_t i, glm::vec3 position_ws,
                                                            glm::vec2 u) const {
    const auto from = origin(i, u);
    if (!from) return std::nullopt;
    const auto offset = from->position_ws - position_ws;
    const float squared = glm::dot(offset, offset), distance = std::sqrt(squared);
    const float pdf = pdf_at(triangles_[i], offset, squared, distance);
    if (!(pdf > 0)) return std::nullopt;
    return Point{offset / distance, distance, from->radiance, pdf};
}

float TriangleLights::pdf(std::size_t i, glm::vec3 position_ws, float u, float v) const {
    const auto& t = triangles_[i];
    const auto offset = t.corner + u * t.edge_u + v * t.edge_v - position_ws;
    const float squared = glm::dot(offset, offset);
    return pdf_at(t, offset, squared, std::sqrt(squared));
}

}  // namespace ir::passes
