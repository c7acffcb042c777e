#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderers/core/fields.h"
#include "renderers/methods/ldm-indirect/parameters.h"
#include "renderers/scene/world.h"
#include "shaders/methods/ldm-indirect/splatting/explain.comp.h"

namespace ir::methods::ldm_indirect {

/// As the buffer PixelSum of explain.comp.
struct PixelSum {
    std::uint32_t pixel_x, pixel_y, photons;
    std::array<float, 3> gathered, direct, pixel, difference;
    IR_FIELDS(pixel_x, pixel_y, photons, gathered, direct, pixel, difference)
};

/// One of the 2N directions; `centre` points to where its light comes from.
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

/// Sets gathered, direct and difference.
void add_up(std::span<const FoundPhoton> photons, PixelSum& sum);

/// Two for each map: of light that came along its direction (side 1) and against it (side -1).
std::vector<DirectionLight> light_by_direction(std::span<const FoundPhoton> photons,
                                               const passes::ldm::Options& options);

/// Photons of lights without a place have none, nor have those of sources from `texels` on.
std::vector<PathLine> paths_of(std::span<const FoundPhoton> photons, const passes::ldm::Options& options,
                               const scene::World& world, std::uint64_t texels);

}  // namespace ir::methods::ldm_indirect
