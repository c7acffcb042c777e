#pragma once

#include "renderers/graph/pass_context.h"
#include "renderers/methods/ldm-indirect/tracing.h"

namespace ir::methods::ldm_indirect {

inline const std::string folder = "methods/ldm-indirect/splatting/";  ///< of its shaders

/// The photons that are there to be splatted.
struct StoredPhotons {
    graph::BufferRef records;
    graph::BufferRef stored;    ///< "splat.stored": how many, at most the capacity of records
    graph::BufferRef arrivals;  ///< "splat.arrivals": where light comes from
    Parameters parameters;
    graph::CounterRef count = {};  ///< of records; may exceed their capacity
};

/// Footprints that are not drawn as they are.
struct MendedCounters {
    graph::CounterRef axes_short, axes_long, degenerate, broken;
};
MendedCounters declare_mended(graph::GraphBuilder& builder);

/// Declares the passes "upload arrivals" and "stored photons".
StoredPhotons stored_photons(graph::GraphBuilder& builder, const Photons& photons,
                             const Parameters& parameters);

/// Declares the pass "measure footprints", which counts those that are mended.
void measure_footprints(graph::GraphBuilder& builder, const StoredPhotons& photons);

/// As footprint.glsl reads them: directions of the maps, then of the lights.
std::vector<glm::vec4> arrivals_of(const Parameters& parameters, const scene::World& world);

/// Passes over photons are divided into this many parts of the buffer, as how many there are is known on the
/// device only.
inline constexpr std::int64_t photon_parts = 1024;

struct PhotonRange {
    std::int64_t first, end;
};
PhotonRange photons_of(const graph::PassContext& context, const StoredPhotons& photons, graph::Slice slice);

/// Declares what splatting/footprint.glsl reads.
void reads_footprints(graph::PassBuilder& pass, const StoredPhotons& photons);

/// Constants of splatting/footprint.glsl.
struct Footprints {
    glm::vec3 eye_ws, view_axis_ws;
    float near_plane, pixel_size, splat_size, topological_bias, min_axis_pixels, longest_axis;
    unsigned map_count, light_count;
    bool perspective, count_indirect, count_direct;
    IR_FIELDS(eye_ws, view_axis_ws, near_plane, pixel_size, splat_size, topological_bias, min_axis_pixels,
              longest_axis, map_count, light_count, perspective, count_indirect, count_direct)
};
Footprints footprints(const graph::FrameInputs& inputs, const Parameters& parameters);

/// Constants of splatting/outline.glsl and what it includes.
struct Outlines {
    Footprints footprints;
    glm::mat4 clip_from_world;
    glm::vec2 size_px;
    IR_FIELDS(footprints, clip_from_world, size_px)
};
Outlines outlines(const graph::FrameInputs& inputs, const Parameters& parameters);

}  // namespace ir::methods::ldm_indirect
