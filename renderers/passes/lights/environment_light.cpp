#include "renderers/passes/lights/environment_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderers/core/constants.h"
#include "renderers/passes/lights/equirectangular.h"
#include "renderers/passes/lights/luminance.h"
#include "renderers/scene/frame.h"

namespace ir::passes {
namespace {

glm::vec3 sane(glm::vec3 radiance) {
    for (int c = 0; c < 3; ++c)
        if (!(radiance[c] > 0) || !std::isfinite(radiance[c])) radiance[c] = 0;
    return radiance;
}

glm::vec3 uniform_on_sphere(glm::vec2 u) {
    return equirectangular_direction(u.x, 1.0 - 2.0 * u.y);
}

glm::vec3 cosine_on_hemisphere(glm::vec3 normal_ws, glm::vec2 u) {
    const glm::vec3 tangent = scene::any_tangent(normal_ws);
    const float radius = std::sqrt(u.y), phi = 2 * pi * u.x;
    return glm::normalize(radius * std::cos(phi) * tangent +
                          radius * std::sin(phi) * glm::cross(normal_ws, tangent) +
                          std::sqrt(1 - u.y) * normal_ws);
}

int cell(float coordinate, int size) {
    return std::clamp(static_cast<int>(coordinate * static_cast<float>(size)), 0, size - 1);
}

}  // namespace

EnvironmentLight::EnvironmentLight(const scene::Environment& environment)
    : constant_(sane(environment.constant)) {
    if (environment.map && !environment.map->empty()) map_ = environment.map;
    if (map_)
        build_distribution();
    else
        mean_luminance_ = luminance(constant_);
}

/// Columns go round; rows beyond a pole continue on its other side.
glm::vec3 EnvironmentLight::texel(int x, int y) const {
    const auto& map = *map_;
    if (y < 0 || y >= map.height) {
        y = std::clamp(y, 0, map.height - 1);
        x += map.width / 2;
    }
    x = (x % map.width + map.width) % map.width;
    const float* value = &map.pixels[map.index(x, y)];
    return sane(map.channels >= 3 ? glm::vec3(value[0], value[1], value[2]) : glm::vec3(value[0]));
}

glm::vec3 EnvironmentLight::radiance(glm::vec3 direction_ws) const {
    if (!map_) return constant_;
    const glm::vec2 p =
        equirectangular_uv(direction_ws) * glm::vec2(map_->width, map_->height) - glm::vec2(0.5f);
    const glm::vec2 corner = glm::floor(p), f = p - corner;
    const int x = static_cast<int>(corner.x), y = static_cast<int>(corner.y);
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), f.x),
                    glm::mix(texel(x, y + 1), texel(x + 1, y + 1), f.x), f.y);
}

void EnvironmentLight::build_distribution() {
    const int width = map_->width, height = map_->height;
    cos_edges_.resize(static_cast<std::size_t>(height) + 1);
    for (int y = 0; y <= height; ++y)
        cos_edges_[static_cast<std::size_t>(y)] = std::cos(std::numbers::pi * y / height);
    // What the bilinear look-up sends from a texel's area: (1 6 1)/8 of three texels along either axis. It
    // is above 0 wherever any point of that area shines.
    std::vector<float> light(static_cast<std::size_t>(width));
    const auto column = [&](int x, int y) {
        return (luminance(texel(x, y - 1)) + 6 * luminance(texel(x, y)) + luminance(texel(x, y + 1))) / 8;
    };
    std::vector<double> row_light(static_cast<std::size_t>(height));
    columns_.resize(static_cast<std::size_t>(height));
    double sum = 0;
    for (int y = 0; y < height; ++y) {
        const auto row = static_cast<std::size_t>(y);
        float before = column(-1, y), here = column(0, y);
        for (int x = 0; x < width; ++x) {
            const float after = column(x + 1, y);
            light[static_cast<std::size_t>(x)] = (before + 6 * here + after) / 8;
            before = here;
            here = after;
        }
        columns_[row] = DiscreteDistribution(light.size(), [&](std::size_t x) { return light[x]; });
        double mean = 0;
        for (const float value : light) mean += value;
        row_light[row] = mean / width * height_of(row);
        sum += row_light[row];
    }
    mean_luminance_ = static_cast<float>(sum / 2);
    rows_ = DiscreteDistribution(row_light.size(), [&](std::size_t y) { return row_light[y]; });
}

float EnvironmentLight::texel_pdf(int x, int y) const {
    const auto row = static_cast<std::size_t>(y);
    if (columns_[row].empty()) return 0;
    const float solid_angle = 2 * pi / static_cast<float>(map_->width) * static_cast<float>(height_of(row));
    return rows_.probability(row) * columns_[row].probability(static_cast<std::size_t>(x)) / solid_angle;
}

EnvironmentLight::Sample EnvironmentLight::sample(glm::vec3 normal_ws, glm::vec2 u) const {
    Sample sample;
    if (!map_) {
        const bool has_plane = normal_ws != glm::vec3(0);
        sample.direction_ws = has_plane ? cosine_on_hemisphere(normal_ws, u) : uniform_on_sphere(u);
    } else {
        const auto row = rows_.sample(u.y);
        const auto column = columns_[row.index].sample(u.x);
        sample.direction_ws = equirectangular_direction(
            (static_cast<float>(column.index) + column.rest) / static_cast<float>(map_->width),
            cos_edges_[row.index] - row.rest * height_of(row.index));
    }
    // Not of the texel drawn: rounding may put the direction into its neighbour, where pdf() would look.
    sample.pdf = pdf(normal_ws, sample.direction_ws);
    sample.radiance = radiance(sample.direction_ws);
    return sample;
}

float EnvironmentLight::pdf(glm::vec3 normal_ws, glm::vec3 direction_ws) const {
    if (empty()) return 0;
    if (map_) {
        const glm::vec2 uv = equirectangular_uv(direction_ws);
        return texel_pdf(cell(uv.x, map_->width), cell(uv.y, map_->height));
    }
    if (normal_ws == glm::vec3(0)) return 1 / (4 * pi);
    return std::max(glm::dot(normal_ws, direction_ws), 0.0f) / pi;
}

EnvironmentLight::Tables EnvironmentLight::tables() const {
    if (!map_) return {};
    Tables tables;
    tables.width = map_->width, tables.height = map_->height;
    tables.rows = rows_.cumulative();
    tables.rows.resize(cos_edges_.size());  // of a black map they are empty
    tables.rows.insert(tables.rows.end(), cos_edges_.begin(), cos_edges_.end());
    for (int y = 0; y < tables.height; ++y) {
        tables.rows.push_back(static_cast<float>(height_of(static_cast<std::size_t>(y))));
        const auto& sums = columns_[static_cast<std::size_t>(y)].cumulative();
        for (int x = 0; x < tables.width; ++x) {
            tables.columns.push_back(sums.empty() ? 0 : sums[static_cast<std::size_t>(x) + 1]);
            tables.texels.emplace_back(texel(x, y), 1);
        }
    }
    return tables;
}

}  // namespace ir::passes
