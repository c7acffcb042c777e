#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "renderers/graph/benchmark.h"
#include "renderers/graph/builder.h"
#include "renderers/methods/ldm-ao/parameters.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/ldm/builder.h"
#include "renderers/passes/ldm/points.h"
#include "renderers/passes/ldm/sky.h"
#include "renderers/passes/ldm/walk.h"

namespace ir::methods::ldm_ao {

using passes::ldm::MapsPointer;

struct Images {
    graph::ImageRef sums;     ///< "ldm.sums" rg32f: Σ V cosθ, Σ cosθ
    graph::ImageRef average;  ///< "ldm.average" rg32f with history: mean and frames; only if progressive
    graph::ImageRef accessibility;              ///< r32f
    graph::ImageRef view_counts;                ///< "ldm.self_hit_counts" rgba32f
    graph::ImageRef self_hits, missing, leaks;  ///< r32f, parts of the directions
    graph::ImageRef self_hit_overlay;           ///< rgba16f, linear colours
};

/// The output "ldm.self_hit_overlay".
OutputDescription overlay_output();

Images declare_images(graph::GraphBuilder& builder, const Parameters& parameters);

struct ExactHits;

/// Pass "trace": adds the directions of a batch to the sums. `exact` (may be null) replaces hits of the maps.
void trace(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, MapsPointer maps, int batch,
           const Images& images, const ExactHits* exact);
/// Pass "trace self-hits": the same for the views of self-hits.
void trace_views(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, MapsPointer maps, int batch,
                 const Images& images);
/// Whether the host can do with these parameters what trace() and trace_views() do.
bool has_host_body(const Parameters& parameters);
/// On the host in their place, for all maps: passes "build and trace maps" and "build and trace maps for
/// self-hits"; with `sky` (may be null) that for the sky.
void trace_on_host(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const MapsPointer& maps,
                   const Images& images, const passes::ldm::Sky* sky, const Parameters& parameters);
/// Which hits count, and how much.
passes::ldm::Visibility visibility_of(const Transport& transport);
/// Pass "accessibility".
void resolve(graph::GraphBuilder& builder, const Images& images, const Parameters& parameters);
/// Passes "self-hit views" and "self-hit overlay".
void resolve_views(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Images& images);

/// First hits of exact rays in the directions of a batch of maps, to tell the causes of error apart.
struct ExactHits {
    graph::BufferRef hits;  ///< "ldm.exact_hits": see shaders/methods/ldm-ao/exact.glsl
    graph::ObjectRef bvh;
    Exact exact = Exact::none;
    float texels = 0;  ///< reach of `near`
};

/// Declares the buffer, large enough for every batch; only where exact hits replace those of the maps.
ExactHits declare_exact_hits(graph::GraphBuilder& builder, const passes::ldm::Maps& maps,
                             const Parameters& parameters);

/// Pass "trace exact rays": fills the buffer for a batch.
void trace_exact(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, MapsPointer maps, int batch,
                 const ExactHits& exact, const Transport& transport);

/// Pass "trace selected pixels" (cpu, whatever the processor): of pixels that have much near them it takes
/// the sums from rays.
void trace_selected(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const MapsPointer& maps,
                    const Images& images, const Transport& transport);

/// Constants of exact.glsl.
struct ExactConstants {
    unsigned exact_words = 0;
    float exact_texels = 0;
    IR_FIELDS(exact_words, exact_texels)
};
ExactConstants exact_constants(const ExactHits& exact, const passes::ldm::Maps& maps);

/// Distance up to which hits of the map come from exact rays, m; infinite for all of them.
float exact_reach(const passes::ldm::MapFrame& frame, Exact exact, float texels);

/// What explains the pixel that a person points at. Everything is empty while nobody does, and where the
/// pixel shows no surface.
struct Explanation {
    graph::CountedBuffer hits;    ///< "ldm.explain.hits": the pixel's accessibility, gathered by direction
    graph::CountedBuffer rays;    ///< "ldm.explain.rays": the same as lines
    passes::ldm::WalkViews walk;  ///< through the maps that are chosen
};

/// Their descriptions.
std::vector<OutputDescription> explanation_outputs();

Explanation declare_explanation(graph::GraphBuilder& builder, const passes::ldm::Maps& maps,
                                passes::ldm::MapRange chosen);

/// Passes "explain hits" of all maps of the batch and "explain entries" of those chosen.
void explain(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, MapsPointer maps, int batch,
             graph::BufferRef directions, passes::ldm::MapRange chosen, const Explanation& explanation);

/// What shows by how much the picture, or the picked pixel, changes where one direction is left out.
struct EffectBuffers {
    bool of_picked_pixel = false;
    graph::BufferRef openness;  ///< V by map and pixel
    graph::BufferRef sums;      ///< Σ V cosθ and Σ cosθ by pixel
    /// "ldm.effects" or "ldm.explain.effects": elements of "ldm.directions" and these.
    graph::CountedBuffer effects;
};
using Effects = std::array<EffectBuffers, 2>;

std::vector<OutputDescription> effect_outputs();

Effects declare_effects(graph::GraphBuilder& builder, const passes::ldm::Maps& maps);

/// Passes "query directions" and "query directions of a pixel" of a batch of maps.
void query_effects(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const MapsPointer& maps,
                   int batch, const Effects& effects);

/// Passes "sum directions" and "effects of directions", when all maps were queried, and those of a pixel.
void finish_effects(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const MapsPointer& maps,
                    graph::BufferRef directions, const Effects& effects);

/// Words of an element of "ldm.directions", for shaders.
std::string region_words(const passes::ldm::Maps& maps);

/// Build and trace by each builder and storage against ray tracing of the same directions, and the memory of
/// the published settings.
std::vector<graph::Benchmark> benchmarks();

}  // namespace ir::methods::ldm_ao
