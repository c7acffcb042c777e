#include "renderers/methods/ldm-indirect/splatting/found.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "renderers/image/luminance.h"

namespace ir::methods::ldm_indirect {
namespace {

using passes::ldm::Direction;

glm::dvec3 vector(const std::array<float, 3>& v) {
    return {v[0], v[1], v[2]};
}

/// Where the photon was split. The point lies on its last leg, so far from its end that both legs are as long
/// as the path: t = (L² - |w|²) / (2 (L - u·w)), w from the end to the light, u back along the leg.
std::optional<glm::dvec3> split_point(glm::dvec3 end, glm::dvec3 back, glm::dvec3 light, double length) {
    const auto w = light - end;
    const double divisor = 2 * (length - glm::dot(back, w));
    if (divisor <= 1e-6 * length) return {};
    const double t = (length * length - glm::dot(w, w)) / divisor;
    return end + std::clamp(t, 0.0, length) * back;
}

PathLine line(const FoundPhoton& photon, std::uint32_t leg, glm::dvec3 start, glm::dvec3 end) {
    return {.start = components(start),
            .end = components(end),
            .contribution = photon.contribution,
            .leg = leg,
            .map = photon.map,
            .side = photon.side,
            .photon = photon.photon};
}

}  // namespace

std::vector<Direction> turned_directions(const passes::ldm::Options& options) {
    using std::numbers::pi;
    auto directions = passes::ldm::leopardi_directions(options.directions);
    if (options.rotation == glm::dmat3(1)) return directions;
    const double half = 0.5 * std::sqrt(2 * pi / options.directions);
    for (auto& direction : directions) {
        const auto centre = glm::normalize(options.rotation * direction.centre);
        const double colatitude = std::acos(centre.y), longitude = std::atan2(centre.z, centre.x),
                     width = std::min(half / std::max(std::sin(colatitude), 1e-3), pi);
        direction = {centre, std::max(colatitude - half, 0.0), std::min(colatitude + half, pi),
                     longitude - width, longitude + width};
    }
    return directions;
}

std::span<FoundPhoton> found_photons(const graph::PassContext& context, const PixelPhotons& pixel) {
    const auto sums = context.elements<const PixelSum>(pixel.sum);
    const auto photons = context.elements<FoundPhoton>(pixel.photons);
    if (sums.empty()) return {};
    return photons.first(std::min<std::size_t>(photons.size(), sums[0].photons));
}

void add_up(std::span<const FoundPhoton> photons, PixelSum& sum) {
    glm::dvec3 all(0), direct(0);
    for (const auto& photon : photons) {
        all += vector(photon.contribution);
        if (photon.side == 0) direct += vector(photon.contribution);
    }
    sum.gathered = components(all);
    sum.direct = components(direct);
    sum.difference = components(vector(sum.pixel) - all);
}

std::vector<DirectionLight> light_by_direction(std::span<const FoundPhoton> photons,
                                               const passes::ldm::Options& options) {
    const auto directions = turned_directions(options);
    const int maps = options.directions;
    std::vector<DirectionLight> result;
    for (int map = 0; map < maps; ++map)
        for (const int side : {1, -1})
            set_region(result.emplace_back(), directions[static_cast<std::size_t>(map)], map, side);
    std::vector<glm::dvec3> sums(result.size(), glm::dvec3(0));
    for (const auto& photon : photons) {
        const auto place = 2 * std::size_t{photon.map} + (photon.side > 0 ? 0 : 1);
        if (photon.side == 0 || place >= sums.size()) continue;
        sums[place] += vector(photon.contribution);
        ++result[place].photons;
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
        result[i].contribution = components(sums[i]);
        result[i].luminance = static_cast<float>(luminance(sums[i].r, sums[i].g, sums[i].b));
    }
    return result;
}

std::vector<PathLine> paths_of(std::span<const FoundPhoton> photons, const passes::ldm::Options& options,
                               const scene::World& world, std::uint64_t texels) {
    const auto directions = turned_directions(options);
    std::vector<PathLine> lines;
    for (const auto& photon : photons) {
        if (photon.light >= world.lights.size() || photon.source >= texels) continue;
        const auto& light = world.lights[photon.light];
        // Others do not start at one point.
        if (light.type != scene::LightType::point && light.type != scene::LightType::spot) continue;
        const auto end = vector(photon.centre), start = glm::dvec3(light.position);
        if (photon.side == 0) {
            lines.push_back(line(photon, 0, start, end));
        } else if (photon.map < directions.size()) {
            const auto back = -double(photon.side) * directions[photon.map].centre;
            const auto middle = split_point(end, back, start, photon.path_length);
            if (!middle) continue;
            lines.push_back(line(photon, 0, start, *middle));
            lines.push_back(line(photon, 1, *middle, end));
        }
    }
    return lines;
}

}  // namespace ir::methods::ldm_indirect
