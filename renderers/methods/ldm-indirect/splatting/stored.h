#pragma once

#include "renderers/graph/pass_context.h"
#include "renderers/methods/ldm-indirect/splatting/ellipses.h"
#include "renderers/methods/ldm-indirect/stages.h"
#include "renderers/passes/photons/photon_list.h"

namespace ir::methods::ldm_indirect {

inline const std::string folder = "methods/ldm-indirect/splatting/";  ///< of its shaders

/// The photons that are there to be splatted.
struct StoredPhotons : passes::PhotonList {
    graph::BufferRef arrivals;  ///< "splat.arrivals": where light comes from
    Parameters parameters;
    graph::CounterRef count = {};                ///< of records; may exceed their capacity
    std::optional<graph::BufferRef> looks = {};  ///< where footprints are clipped
};

/// Footprints that are not drawn as they are.
struct MendedCounters {
    graph::CounterRef axes_short, axes_long, degenerate, broken;
};
MendedCounters declare_mended(graph::GraphBuilder& builder);

/// Declares "splat.arrivals" and the pass "upload arrivals".
graph::BufferRef upload_arrivals(graph::GraphBuilder& builder, const Parameters& parameters);

/// Declares the passes "upload arrivals", unless the photons have it, and "stored photons".
StoredPhotons stored_photons(graph::GraphBuilder& builder, const Photons& photons,
                             const Parameters& parameters);

/// Those that were splatted.
StoredPhotons splatted_photons(const Photons& photons, const Splat& splat, const Parameters& parameters);

/// Declares the pass "measure footprints", which counts those that are mended.
void measure_footprints(graph::GraphBuilder& builder, const StoredPhotons& photons);

/// As footprint.glsl reads them: directions of the maps, then of the lights.
std::vector<glm::vec4> arrivals_of(const Parameters& parameters, const scene::World& world);

/// Declares what splatting/footprint.glsl reads.
void reads_footprints(graph::PassBuilder& pass, const StoredPhotons& photons);

/// Constants of splatting/footprint.glsl.
struct Footprints {
    Ellipses ellipses;
    unsigned map_count, light_count;
    bool count_indirect, count_direct, turns_receivers, clips;
    IR_FIELDS(ellipses, map_count, light_count, count_indirect, count_direct, turns_receivers, clips)
};
Footprints footprints(const graph::FrameInputs& inputs, const StoredPhotons& photons);

/// A pass whose program uses clipping.glsl: declares what that reads; its define; its constants.
void reads_looks(graph::PassBuilder& pass, const StoredPhotons& photons);
void define_clipped(gl::ProgramSource& source, const StoredPhotons& photons);
void set_units(const graph::PassContext& context, const gl::Program& program, const StoredPhotons& photons);

/// Constants of splatting/outline.glsl and what it includes.
struct Outlines {
    Footprints footprints;
    glm::mat4 clip_from_world;
    glm::vec2 size_px;
    IR_FIELDS(footprints, clip_from_world, size_px)
};
Outlines outlines(const graph::FrameInputs& inputs, const StoredPhotons& photons);

/// What all forms of splatting have in common: photons, the surfaces that they light, and the picture of
/// sums.
struct SplatTask {
    StoredPhotons photons;
    graph::ImageRef position, normal;  ///< of the G-buffer; normal is the geometric one
    graph::ImageRef irradiance;        ///< rgba32f
    graph::ImageRef direction;         ///< rgba32f
};

void reads_task(graph::PassBuilder& pass, const SplatTask& task);

/// Points that a geometry shader makes rectangles of, added by blending in the order of the photons.
void splat_quads(graph::GraphBuilder& builder, const SplatTask& task);
/// Photons are sorted into bins of tiles, and pixels sum those of their bin in the order of the photons.
void splat_tiles(graph::GraphBuilder& builder, const SplatTask& task);
/// In place of splat_tiles: threads add photons to tiles of pixels in the caches of the host, in their order.
void splat_on_host(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const SplatTask& task);
/// A compute shader adds each photon to its pixels by atomic additions, in no order.
void splat_image_atomics(graph::GraphBuilder& builder, const SplatTask& task);
/// "splat.sums", to which atomic_add.glsl adds; what its program needs, before use(); the picture made of it.
graph::ImageRef declare_sums(graph::GraphBuilder& builder);
void add_by_atomics(const graph::PassContext& context, gl::ProgramSource& source, graph::ImageRef sums);
void show_sums(graph::GraphBuilder& builder, const SplatTask& task, graph::ImageRef sums);

}  // namespace ir::methods::ldm_indirect
