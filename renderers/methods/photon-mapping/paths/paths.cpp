#include "renderers/methods/photon-mapping/paths/paths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

namespace ir::methods::photon_mapping {
namespace {

constexpr std::uint32_t seed_bits = (1u << 20) - 1;  ///< that a photon keeps

using Seeds = std::unordered_multimap<std::uint32_t, std::size_t>;

glm::vec3 vector(const std::array<float, 3>& v) {
    return {v[0], v[1], v[2]};
}
std::array<float, 3> floats(glm::vec3 v) {
    return {v.x, v.y, v.z};
}

/// Sample points by the part of their seeds that the photons found have.
Seeds points_of(std::span<const FoundPhoton> found, const PathRecords& records) {
    std::unordered_map<std::uint32_t, bool> wanted;
    for (const auto& each : found)
        if (each.photon < records.photons.size()) wanted[records.photons[each.photon].bits >> 12] = true;
    Seeds seeds;
    for (std::size_t i = 0; i < records.samples.size(); ++i)
        if (const auto seed = records.samples[i].seed & seed_bits; wanted.contains(seed))
            seeds.emplace(seed, i);
    return seeds;
}

/// Where a photon lies on which path.
struct Place {
    std::size_t point = 0, path = 0;
    int surface = 0;
};

std::optional<Place> place_of(const Photon& photon, const Seeds& seeds, const PathRecords& records) {
    std::optional<Place> best;
    float nearest = records.tolerance;
    const auto length = static_cast<std::size_t>(records.surfaces + 1);
    const auto [begin, end] = seeds.equal_range(photon.bits >> 12);
    for (auto seed = begin; seed != end; ++seed)
        for (int repeat = 0; repeat < records.photons_per_point; ++repeat) {
            const auto path = seed->second * static_cast<std::size_t>(records.photons_per_point) +
                              static_cast<std::size_t>(repeat);
            if ((path + 1) * length > records.vertices.size()) continue;
            for (int n = 1; n <= records.surfaces; ++n) {
                const auto place =
                    vector(records.vertices[path * length + static_cast<std::size_t>(n)].position);
                const float distance = glm::distance(place, photon.position_ws);
                if (distance < nearest) nearest = distance, best = {seed->second, path, n};
            }
        }
    return best;
}

/// Where the light of a point comes from: the light's place, of directional ones that of the map's near
/// plane.
std::optional<glm::vec3> light_of(const SamplePoint& point, const PathRecords& records) {
    if (point.origin != no_texel) {
        const auto layer = static_cast<std::size_t>(point.origin >> 20 & 63);
        if (layer >= records.sources.size()) return {};
        const auto& source = records.sources[layer];
        if (source.perspective > 0) return source.origin_ws;
        return point.position_ws -
               glm::dot(point.position_ws - source.origin_ws, source.direction_ws) * source.direction_ws;
    }
    const auto ray = point.seed % records.all_points - records.from_maps;
    if (ray >= records.rays.size()) return {};
    return records.rays[ray].origin_ws;
}

}  // namespace

std::vector<PathLeg> legs_of(std::span<const FoundPhoton> found, const PathRecords& records, int chosen) {
    const auto seeds = points_of(found, records);
    std::vector<PathLeg> legs;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto& photon = found[i];
        if (photon.photon >= records.photons.size()) continue;
        const auto place = place_of(records.photons[photon.photon], seeds, records);
        if (!place) continue;
        const auto& point = records.samples[place->point];
        std::vector<glm::vec3> stops;
        const auto light = light_of(point, records);
        if (light) stops.push_back(*light);
        const auto* vertices =
            &records.vertices[place->path * static_cast<std::size_t>(records.surfaces + 1)];
        // before mirrors and glass the path leaves from a place on the light's ray
        for (int n = (point.light & leaves_along_ray) != 0 ? 1 : 0; n <= place->surface; ++n)
            stops.push_back(vector(vertices[n].position));
        for (std::size_t leg = 0; leg + 1 < stops.size(); ++leg)
            legs.push_back({.start = floats(stops[leg]),
                            .end = floats(stops[leg + 1]),
                            .leg = static_cast<std::uint32_t>(light ? leg : leg + 1),
                            .bounce = photon.bounce,
                            .light = photon.light,
                            .contribution = photon.contribution,
                            .photon = photon.photon,
                            .path = static_cast<std::uint32_t>(i),
                            .chosen = chosen == static_cast<int>(i) ? 1u : 0u});
    }
    return legs;
}

}  // namespace ir::methods::photon_mapping
