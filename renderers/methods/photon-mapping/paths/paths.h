#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderers/core/fields.h"
#include "renderers/methods/photon-mapping/stages.h"
#include "renderers/scene/world.h"
#include "shaders/methods/photon-mapping/records.glsl.h"
#include "shaders/methods/photon-mapping/splatting/explain.comp.h"
#include "shaders/methods/photon-mapping/tracing/follow.comp.h"
#include "shaders/passes/raytracing/rays.glsl.h"

namespace ir::methods::photon_mapping {

/// A leg of the way from a light to a photon that lights the picked pixel.
struct PathLeg {
    std::array<float, 3> start, end;
    std::uint32_t leg;     ///< 0: from the light; n: from the n-th surface, mirrors and glass included
    std::uint32_t bounce;  ///< of the photon
    std::uint32_t light;
    std::array<float, 3> contribution;
    std::uint32_t photon;  ///< in the photon buffer
    std::uint32_t path;    ///< by strength, from 0
    std::uint32_t chosen;  ///< 1: the path that the selector names
    IR_FIELDS(start, end, leg, bounce, light, contribution, photon, path, chosen)
};

/// What a frame knows of the ways of its photons.
struct PathRecords {
    std::span<const SamplePoint> samples;  ///< of the frame
    std::span<const SourceData> sources;   ///< layers of the RSM first
    std::span<const Photon> photons;
    std::span<const PathVertex> vertices;          ///< as PhotonLegs has them
    std::span<const passes::RayRecord> rays = {};  ///< traced from lights; empty where none are
    int surfaces = 0, photons_per_point = 1;
    std::uint32_t all_points = 1, from_maps = 0;  ///< as EmissionPoints has them
    float tolerance = 0;                          ///< m between a photon and its path
};

/// The legs of each photon that is found, from the light on; none for those whose path was not kept.
/// `chosen`: the place of one in `found`; negative: none.
std::vector<PathLeg> legs_of(std::span<const FoundPhoton> found, const PathRecords& records, int chosen);

}  // namespace ir::methods::photon_mapping
