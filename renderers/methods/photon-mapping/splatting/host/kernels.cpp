#include "renderers/methods/photon-mapping/splatting/host/kernels.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/constants.h"
#include "renderers/methods/photon-mapping/unpacked.h"
#include "renderers/scene/frame.h"
#include "shaders/methods/photon-mapping/splatting/kernel.glsl.h"
#include "shaders/methods/photon-mapping/splatting/photon_kernel.glsl.h"

namespace ir::methods::photon_mapping {
namespace {

/// The order of arguments makes 0 of what is no number.
int clamped(float value, int end) {
    return static_cast<int>(std::min(std::max(0.0f, value), static_cast<float>(end)));
}

// As in kernel.glsl:
float tile_area(float depth, float c_tile, bool perspective) {
    return perspective ? depth * depth * c_tile : c_tile;
}
float surface_area(float area, float facing) {
    return area / std::max(facing, least_facing);
}

/// Unit: stretched_direction of kernel.glsl.
glm::vec3 stretched_direction(glm::vec3 n, glm::vec3 to_light) {
    const auto in_plane = to_light - glm::dot(n, to_light) * n;
    const float size = glm::length(in_plane);
    return size > 1e-4f ? in_plane / size : scene::any_tangent(n);
}

}  // namespace

KernelMaker::KernelMaker(const KernelRules& rules, std::span<const std::uint32_t> photons_by_tile,
                         int columns, const TexelPlanes* probed)
    : r_(rules),
      tiles_(photons_by_tile),
      columns_(columns),
      rows_(static_cast<int>(photons_by_tile.size()) / columns),
      probed_(probed) {
    const auto rows = glm::transpose(rules.view.clip_from_world);
    const auto size = rules.view.size_texels;
    texel_x_ = 0.5f * size.x * (rows[3] + rows[0]);
    texel_y_ = 0.5f * size.y * (rows[3] - rows[1]);
    texel_w_ = rows[3];
}

float KernelMaker::photons_of_tile(glm::vec3 position_ws) const {
    const glm::vec4 p(position_ws, 1);
    const auto scale = 1 / (glm::dot(texel_w_, p) * static_cast<float>(r_.tile_size));
    const int column = clamped(glm::dot(texel_x_, p) * scale, columns_ - 1);
    const int row = clamped(glm::dot(texel_y_, p) * scale, rows_ - 1);
    const auto count = tiles_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                              static_cast<std::size_t>(column)];
    return static_cast<float>(std::max(count, 1u));
}

bool KernelMaker::faces_viewer(glm::vec3 position_ws, glm::vec3 normal_ws) const {
    const auto& view = r_.view;
    return glm::dot(normal_ws, view.perspective ? view.eye_ws - position_ws : -view.view_axis_ws) > 0;
}

/// kernel_radius of photon_kernel.glsl.
float KernelMaker::radius(const Photon& photon, glm::vec3 n) const {
    const auto& view = r_.view;
    const float depth = glm::dot(photon.position_ws - view.eye_ws, view.view_axis_ws);
    const float facing =
        glm::dot(n, view.perspective ? (view.eye_ws - photon.position_ws) / depth : -view.view_axis_ws);
    const float tile = surface_area(tile_area(depth, r_.c_tile, view.perspective), facing);
    const float share = tile / photons_of_tile(photon.position_ws);
    const float s_l = std::clamp(photon.ray_length / r_.l_max, r_.min_ray_length_scale, 1.0f);
    const float s_d = std::clamp(std::sqrt(share / pi), r_.r_min, r_.r_max) * std::sqrt(r_.n_tile);
    const float texel = std::sqrt(surface_area(tile_area(depth, r_.c_texel, view.perspective), facing));
    return r_.shrinking * std::max(s_l * s_d, r_.min_radius_texels * texel);
}

/// Planes that touch an ellipsoid with half-axes a_i about c meet (p·a_1)² + (p·a_2)² + (p·a_3)² = (p·c)²;
/// for those through the eye and a column of texels this is a quadratic equation of the column. Columns count
/// from that of the middle, so that nothing cancels.
TexelBox KernelMaker::box_of(glm::vec3 centre_ws, const glm::mat3& half_axes) const {
    const glm::vec4 centre(centre_ws, 1);
    const float w = glm::dot(texel_w_, centre);
    const auto b = glm::vec3(texel_w_) * half_axes;
    const float squared = w * w, most = glm::dot(b, b) - squared;
    const auto size = glm::ivec2(r_.view.size_texels);
    if (most > -1e-6f * squared) return {0, size.x, 0, size.y};  // reaches the plane through the eye
    if (w < 0) return {};
    const auto bounds = [&](const glm::vec4& row, int end) {
        const float middle = glm::dot(row, centre) / w;
        const auto a = glm::vec3(row - middle * texel_w_) * half_axes;
        const float ab = glm::dot(a, b), root = std::sqrt(ab * ab - glm::dot(a, a) * most);
        constexpr float margin = 0.05f;  // texels: rounding; what is not covered is found out later
        const float least = middle + (ab + root) / most, largest = middle + (ab - root) / most;
        return glm::ivec2(clamped(std::ceil(least - 0.5f - margin), end),
                          clamped(std::floor(largest + 0.5f + margin), end));
    };
    const auto x = bounds(texel_x_, size.x), y = bounds(texel_y_, size.y);
    return {x.x, x.y, y.x, y.y};
}

/// As in photon_kernel.glsl.
bool KernelMaker::finds_surface(const HostKernel& kernel, glm::vec3 n, glm::vec3 place_ws,
                                float half_thickness, float longest) const {
    const auto& view = r_.view;
    if (glm::dot(place_ws - view.eye_ws, view.view_axis_ws) <= 0) return true;
    const glm::vec4 place(place_ws, 1);
    const float scale = 1 / glm::dot(texel_w_, place);
    const float x = glm::dot(texel_x_, place) * scale, y = glm::dot(texel_y_, place) * scale;
    if (!(x >= 0 && y >= 0 && x < view.size_texels.x && y < view.size_texels.y)) return true;
    const auto at = probed_->place(static_cast<int>(x), static_cast<int>(y));
    const glm::vec3 surface(probed_->position[0][at], probed_->position[1][at], probed_->position[2][at]);
    if (surface.x == TexelPlanes::nowhere) return false;
    const auto offset = surface - kernel.centre_ws;
    const float height = glm::dot(n, offset);
    return std::abs(height) <= half_thickness || (height > 0 && glm::length(offset) > longest);
}

float KernelMaker::covered_part(const HostKernel& kernel, const glm::mat3& half_axes, glm::vec3 n) const {
    const glm::vec3 sizes(glm::length(half_axes[0]), glm::length(half_axes[1]), glm::length(half_axes[2]));
    const float longest = std::max({sizes.x, sizes.y, sizes.z});
    int found = 0;
    for (int i = 0; i < probe_count; ++i) {
        const float squared = (static_cast<float>(i) + 0.5f) / probe_count,
                    angle = golden_angle * static_cast<float>(i);
        const auto place =
            std::sqrt(squared) * (std::cos(angle) * half_axes[0] + std::sin(angle) * half_axes[1]);
        found +=
            finds_surface(kernel, n, kernel.centre_ws + place, std::sqrt(1 - squared) * sizes.z, longest);
    }
    return static_cast<float>(std::max(found, least_found)) / probe_count;
}

std::optional<HostKernel> KernelMaker::make(const Photon& photon, TexelBox& box) const {
    const auto n = normal_of(photon), to_light = direction_of(photon);
    const auto& centre = photon.position_ws;
    box = {};
    if (!std::isfinite(centre.x + centre.y + centre.z) || !faces_viewer(centre, n)) return {};
    const auto u = stretched_direction(n, to_light), t = glm::cross(n, u);
    const float size = radius(photon, n), cosine = glm::dot(n, to_light);
    const glm::vec3 axes = size * glm::vec3(cosine * r_.s_max > 1 ? 1 / cosine : r_.s_max, 1, r_.s_n);
    const glm::mat3 half_axes(axes.x * u, axes.y * t, axes.z * n);
    box = box_of(centre, half_axes);
    if (box.is_empty()) return {};
    HostKernel kernel{centre, u / axes.x, t / axes.y, n / axes.z, to_light, {}};
    const float area = pi * axes.x * axes.y * (probed_ ? covered_part(kernel, half_axes, n) : 1);
    const auto irradiance = unpacked_power(photon.power) * (r_.power_unit / area);
    const auto weighted = (irradiance.x + irradiance.y + irradiance.z) * to_light;
    for (int i = 0; i < 3; ++i) kernel.added[i] = irradiance[i], kernel.added[i + 3] = weighted[i];
    return kernel;
}

}  // namespace ir::methods::photon_mapping
