#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "renderers/gl/program.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/deep-screen-space/surfels.h"
#include "shaders/methods/deep-screen-space/surfels/fine.glsl.h"
#include "shaders/methods/deep-screen-space/surfels/parts.glsl.h"

/// The steps by which surfels are made, in their order; all but their light is kept as long as the
/// fingerprint stays. [Nalbach15 fig. 6]
namespace ir::methods::deep_screen_space {
/// Passes over items whose number only the device knows are divided into so many parts (parts.glsl).
inline constexpr std::int64_t packing_parts = parts;

/// Runs a compute program in use, with groups of 64 that include parts.glsl, for a slice of the parts of a
/// list with this capacity. Gives the constants of parts.glsl.
void dispatch_parts(const gl::Program& program, std::uint64_t capacity, graph::Slice slice);

/// Declares a growable buffer with the counter that makes it grow, of `reserve` elements at first.
struct Growing {
    graph::BufferRef buffer;
    graph::CounterRef count;
};
Growing growing(graph::GraphBuilder& builder, graph::BufferDesc desc, graph::CounterDesc counter,
                std::uint64_t reserve);

/// Surfels in this buffer, with `stored`.
Surfels declare_surfels(graph::GraphBuilder& builder, const Growing& records, const std::string& fingerprint);
/// And with the pass that fills it, of what the device counted.
Surfels count_stored(graph::GraphBuilder& builder, const Growing& records, const std::string& fingerprint);

/// Parts of triangles that the tessellator divides, in the order of triangles; struct Patch of patch.glsl.
struct Patches {
    Growing list;                 ///< "surfels.patches.list"
    Growing points;               ///< "surfels.points": before each how many points the tessellator makes, or
                                  ///< systematic how much all are worth, in units of patch.glsl
    graph::CounterRef total;      ///< of points or units
    graph::CounterRef triangles;  ///< that are not culled
    graph::BufferRef left;        ///< "surfels.left": of the host, whose counters the device does not see
};

/// Surfels, unlit, and the patches that they were placed on.
struct Placed {
    Patches patches;
    Surfels surfels;
};

/// What both bodies count of patches.
graph::CounterRef declare_units(graph::GraphBuilder& builder);  ///< systematic placement's total
graph::CounterRef declare_triangles_left(graph::GraphBuilder& builder);
graph::CounterDesc patches_counter();

/// Declares the passes that cull triangles and split those that are too large, and add to `total` how many
/// points, or units, that makes. [Nalbach15 fig. 6 a]
Patches cut_patches(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, graph::CounterRef total,
                    float reach, std::uint64_t reserve, const Parameters& parameters,
                    const std::string& fingerprint);

/// Declares "surfels.fine", without what fills it: patches count what goes into it.
Growing declare_fine(graph::GraphBuilder& builder, std::uint64_t reserve, const std::string& fingerprint);

/// Declares the pass that fills it, by hardware tessellation. [Nalbach15 fig. 6 b]
void tessellate(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const Patches& patches,
                const Growing& fine, const Parameters& parameters, const std::string& fingerprint);

/// Declares "surfels.records" without what fills it.
Growing declare_records(graph::GraphBuilder& builder, std::uint64_t reserve, const std::string& fingerprint);

/// Declares "surfels.order", the triangles in the order of systematic placement, kept while the geometry
/// stays.
graph::BufferRef order_triangles(graph::GraphBuilder& builder);

/// Declares "surfels.records" with the pass that places surfels on the patches, systematically and unlit.
/// Needs neither fine surfels nor thinning.
Surfels place(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const Patches& patches,
              std::uint64_t reserve, const Parameters& parameters, const std::string& fingerprint);

/// Declares "surfels.records" with the passes that keep some of the fine ones, unlit. [Nalbach15 fig. 6 c]
Surfels thin(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const Growing& fine,
             std::uint64_t reserve, const Parameters& parameters, const std::string& fingerprint);

/// Declares "surfels.irradiance" with the pass that fills it, on the host: what sources with an extent send
/// to both sides of each surfel, by samples. None where there is no such source, or no sample.
std::optional<graph::BufferRef> sample_sources(graph::GraphBuilder& builder, const Surfels& surfels,
                                               const Parameters& parameters);

/// Declares "surfels.lights" with the pass that fills it. [Nalbach15 fig. 6 d]
graph::BufferRef shade(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                       const passes::ShadowMaps& shadow, const Surfels& surfels,
                       const Parameters& parameters);

/// Declares the output "surfels", of as many elements, which says of each which one it is.
void show_surfels(graph::GraphBuilder& builder, const Surfels& surfels, std::uint64_t reserve,
                  const Parameters& parameters);

/// The row of "surfels.counts".
struct SurfelCounts {
    std::uint32_t triangles, left, patches, fine, kept;
    float fine_area, kept_area;  ///< m²
    float fine_part, kept_part;  ///< means of area over ideal area
    IR_FIELDS(triangles, left, patches, fine, kept, fine_area, kept_area, fine_part, kept_part)
};

/// Declares the table and what it needs; nothing of it runs while nobody looks. `fine`: null where there are
/// none.
void count_surfels(graph::GraphBuilder& builder, const Patches& patches, const Growing* fine,
                   const Surfels& surfels, const Parameters& parameters);

/// Surfels placed systematically by the host's threads: what cut_patches() and place() make on the device,
/// but for rounding, which may move all surfels behind a patch along the curve. `patches` has counters alone.
Placed place_on_host(graph::GraphBuilder& builder, float reach, std::uint64_t reserve,
                     const Parameters& parameters, const std::string& fingerprint);

/// Declares the pass "shade surfels" on the host's threads: what shade.comp writes into `lights`.
/// `irradiance`: by sources with an extent (sample_sources()).
void shade_on_host(graph::GraphBuilder& builder, const passes::ShadowMaps& shadow, const Surfels& surfels,
                   const std::optional<graph::BufferRef>& irradiance, const Growing& lights,
                   const Parameters& parameters);

}  // namespace ir::methods::deep_screen_space
