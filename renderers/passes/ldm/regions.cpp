#include "renderers/passes/ldm/regions.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderers/passes/lights/environment_light.h"
#include "renderers/passes/lights/equirectangular.h"

namespace ir::passes::ldm {
namespace {

using std::numbers::pi;

/// Points along a meridian at least: a region of 1024 directions has about 300 of them.
constexpr int min_region_rows = 512;
/// Rows are added up in so many blocks, in their order.
constexpr int region_blocks = 64;

struct RegionSum {
    glm::dvec3 light{0};  ///< radiance times solid angle
    double solid_angle = 0;
};

}  // namespace

Regions::Regions(int count) : directions_(leopardi_directions(count)) {
    for (std::size_t i = 0; i < directions_.size(); ++i) {
        const auto& d = directions_[i];
        if (collars_.empty() || collars_.back().top != d.colatitude_min)
            collars_.push_back({d.colatitude_min, d.colatitude_max, d.longitude_min,
                                d.longitude_max - d.longitude_min, i, 0});
        ++collars_.back().kept;
    }
    const auto collars = collar_counts(2 * count).size();
    if (collars > 0) height_ = (pi - 2 * collars_.front().bottom) / static_cast<double>(collars);
}

const Regions::Collar& Regions::collar_at(double colatitude) const {
    // Areas move the borders of collars by a part of their height.
    const double guess = 1 + (colatitude - collars_.front().bottom) / height_;
    auto i = std::min(static_cast<std::size_t>(std::max(guess, 0.0)), collars_.size() - 1);
    while (i > 0 && colatitude < collars_[i].top) --i;
    while (i + 1 < collars_.size() && colatitude > collars_[i].bottom) ++i;
    return collars_[i];
}

std::size_t Regions::find(const glm::dvec3& direction) const {
    for (std::size_t side = 0; side < 2; ++side) {
        const auto d = side == 0 ? direction : -direction;
        const double colatitude = std::acos(std::clamp(d.y, -1.0, 1.0)), longitude = std::atan2(d.z, d.x);
        const auto& collar = collar_at(colatitude);
        if (colatitude > collar.bottom) continue;
        const double turns = (longitude - collar.begin) / (2 * pi);
        const auto place = static_cast<std::size_t>((turns - std::floor(turns)) * 2 * pi / collar.step);
        if (place < collar.kept) return 2 * (collar.first + place) + side;
    }
    // Rounding left it on a border.
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < directions_.size(); ++i)
        if (std::abs(glm::dot(directions_[i].centre, direction)) >
            std::abs(glm::dot(directions_[nearest].centre, direction)))
            nearest = i;
    return 2 * nearest + (glm::dot(directions_[nearest].centre, direction) < 0);
}

std::vector<glm::vec3> region_radiance(const scene::Environment& environment, int count,
                                       const glm::dmat3& rotation) {
    const Regions regions(count);
    const EnvironmentLight light(environment);
    if (!environment.map || environment.map->empty())
        return std::vector<glm::vec3>(regions.size(), light.radiance({0, 1, 0}));
    // Each texel's own centre, or as many points within it as make up for coarse maps.
    const int divided =
        std::max(1, (min_region_rows + environment.map->height - 1) / environment.map->height);
    const int height = divided * environment.map->height, width = divided * environment.map->width;
    std::vector<std::vector<RegionSum>> sums(region_blocks, std::vector<RegionSum>(regions.size()));
    const auto back = glm::transpose(rotation);
    tbb::parallel_for(0, region_blocks, [&](int block) {
        auto& sum = sums[static_cast<std::size_t>(block)];
        for (int y = height * block / region_blocks; y < height * (block + 1) / region_blocks; ++y) {
            const double solid_angle =
                2 * pi / width * (std::cos(pi * y / height) - std::cos(pi * (y + 1) / height));
            for (int x = 0; x < width; ++x) {
                const auto direction =
                    equirectangular_direction((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                                              std::cos(pi * (y + 0.5) / height));
                auto& region = sum[regions.find(back * glm::dvec3(direction))];
                region.light += solid_angle * glm::dvec3(light.radiance(direction));
                region.solid_angle += solid_angle;
            }
        }
    });
    std::vector<glm::vec3> means(regions.size());
    for (std::size_t i = 0; i < means.size(); ++i) {
        RegionSum all;
        for (const auto& sum : sums) all = {all.light + sum[i].light, all.solid_angle + sum[i].solid_angle};
        means[i] = all.solid_angle > 0 ? glm::vec3(all.light / all.solid_angle) : glm::vec3(0);
    }
    return means;
}

}  // namespace ir::passes::ldm
