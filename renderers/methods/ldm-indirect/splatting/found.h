#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "renderers/core/fields.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/ldm-indirect/stages.h"
#include "renderers/passes/ldm/directions.h"
#include "renderers/scene/world.h"
#include "shaders/methods/ldm-indirect/splatting/explain.comp.h"

namespace ir::methods::ldm_indirect {

/// A vector as records of explanations hold it.
template <class T>
std::array<float, 3> components(const glm::vec<3, T>& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// As the buffer PixelSum of explain.comp.
struct PixelSum {
    std::uint32_t pixel_x, pixel_y, photons;
    std::array<float, 3> gathered, direct, pixel, difference;
    IR_FIELDS(pixel_x, pixel_y, photons, gathered, direct, pixel, difference)
};

/// Directions of the maps. Of a turned set regions are squares of their area about their centres.
std::vector<passes::ldm::Direction> turned_directions(const passes::ldm::Options& options);

/// Sets what the record of one of the 2N directions says of its region. `centre` points to where its light
/// comes from: of light that came along the map's direction, side 1, from its opposite.
template <class Record>
void set_region(Record& record, const passes::ldm::Direction& direction, int map, int side) {
    using std::numbers::pi;
    const bool above = side < 0;
    const auto bounds = [](double low, double high) {
        return std::array{static_cast<float>(low), static_cast<float>(high)};
    };
    for (int axis = 0; axis < 3; ++axis)
        record.centre[static_cast<std::size_t>(axis)] = static_cast<float>(-side * direction.centre[axis]);
    record.colatitude = above ? bounds(direction.colatitude_min, direction.colatitude_max)
                              : bounds(pi - direction.colatitude_max, pi - direction.colatitude_min);
    const double turn = above ? 0 : pi;
    record.longitude = bounds(direction.longitude_min + turn, direction.longitude_max + turn);
    record.map = static_cast<std::uint32_t>(map);
    record.side = side;
}

/// One of the 2N directions.
struct DirectionLight {
    std::array<float, 3> centre;
    std::array<float, 2> colatitude, longitude;
    std::uint32_t map;
    std::int32_t side;
    std::array<float, 3> contribution;
    float luminance;
    std::uint32_t photons;
    IR_FIELDS(centre, colatitude, longitude, map, side, contribution, luminance, photons)
};

struct PathLine {
    std::array<float, 3> start, end, contribution;
    std::uint32_t leg, map;
    std::int32_t side;
    std::uint32_t photon;
    IR_FIELDS(start, end, contribution, leg, map, side, photon)
};

/// What explain() found of the picked pixel; empty where it shows no surface.
std::span<FoundPhoton> found_photons(const graph::PassContext& context, const PixelPhotons& pixel);

/// Sets gathered, direct and difference.
void add_up(std::span<const FoundPhoton> photons, PixelSum& sum);

/// Two for each map: of light that came along its direction (side 1) and against it (side -1).
std::vector<DirectionLight> light_by_direction(std::span<const FoundPhoton> photons,
                                               const passes::ldm::Options& options);

/// Photons of lights without a place have none, nor have those of sources from `texels` on.
std::vector<PathLine> paths_of(std::span<const FoundPhoton> photons, const passes::ldm::Options& options,
                               const scene::World& world, std::uint64_t texels);

}  // namespace ir::methods::ldm_indirect
