#pragma once

#include "renderers/methods/photon-mapping/emission/probability.h"
#include "renderers/methods/photon-mapping/stages.h"

namespace ir::methods::photon_mapping {

/// The points of a frame's emission sets, before and after those that do not survive are left out.
struct EmissionPoints {
    SamplePoints samples;
    std::uint64_t count = 0;      ///< points of all sets of the frame
    std::uint64_t from_maps = 0;  ///< of these the first ones, warped by maps; rays are traced for the rest
    graph::BufferRef candidates;  ///< "emission.candidates": for each of the former bits 0-9 texel x, 10-19
                                  ///< texel y, 20-25 source, 26 set where it survives
    graph::BufferRef survivors;   ///< "emission.survivors": 1 for each point that survives
    graph::BufferRef places;      ///< in "photons.samples", found by find_places
};

/// Points of the first slice of a pass.
inline constexpr std::int64_t first_points_slice = 1 << 14;

/// Declares the buffers, for this many points as the parameters ask for; none without a source.
EmissionPoints declare_points(graph::GraphBuilder& builder, const Sources& sources,
                              const Parameters& parameters);

/// The pass "photon budget": divides the points among the layers.  [Smal19 §5]
/// `maps` is null where no probability map is, and intensities decide. `traced`: the rows of what is traced,
/// with their points, where there is any.
void divide_points(graph::GraphBuilder& builder, const Sources& sources, const EmissionPoints& points,
                   const EmissionMaps* maps, std::optional<graph::BufferRef> traced,
                   const Parameters& parameters);

/// What the passes over the points of maps look at.
struct MappedEmission {
    passes::Rsm rsm;
    EmissionMaps maps;
};
/// The pass "emission points", which warps them and plays roulette.  [Smal19 §5.3.2]
void warp_points(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const Sources& sources,
                 const MappedEmission& mapped, const EmissionPoints& points, const Parameters& parameters);
/// The pass "sample points", which packs the survivors.  [Smal19 §5.3.3]
void pack_points(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const Sources& sources,
                 const MappedEmission& mapped, const EmissionPoints& points, const Parameters& parameters);

/// Declares the scan that packs survivors in the order of their seeds.
void find_places(graph::GraphBuilder& builder, EmissionPoints& points);

/// Constants of shaders/methods/photon-mapping/emission/sources.glsl.
struct EmissionSets {
    unsigned source_count, all_points, strata, stratum, seed_low, seed_high;
    IR_FIELDS(source_count, all_points, strata, stratum, seed_low, seed_high)
    std::uint64_t seed() const { return std::uint64_t{seed_high} << 32 | seed_low; }
};
EmissionSets emission_sets(const graph::FrameInputs& inputs, const Sources& sources,
                           const EmissionPoints& points, const Parameters& parameters);

std::vector<OutputDescription> point_outputs();

}  // namespace ir::methods::photon_mapping
