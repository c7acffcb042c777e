#pragma once

#include <string>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/photon-mapping/stages.h"
#include "renderers/passes/gbuffer/pixel_rays.h"

/// The steps of the filter.
namespace ir::methods::photon_mapping {

inline const std::string folder = "methods/photon-mapping/filtering/";  ///< of its shaders

/// A picture of irradiance with the sum of directions that it comes from, as Splat.
struct Signal {
    graph::ImageRef value;      ///< rgba32f: E, W/m²; x of the direction
    graph::ImageRef direction;  ///< rg32f: y and z of it
};

/// Extent of the work groups of all shaders of the filter, in both directions.
constexpr int group_size = 16;

/// `text` is that of the value.
Signal declare_signal(graph::GraphBuilder& builder, const graph::ResourceText& text);

/// "filter.surfaces" rg32ui: normal and depth of each pixel, as filtering/surface.glsl packs them.
graph::ImageRef pack_surfaces(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer);
/// Constants of filtering/surface.glsl.
struct Edges {
    passes::PixelRays rays;
    float sigma_depth, sigma_normal;
    IR_FIELDS(rays, sigma_depth, sigma_normal)
};
Edges edges(const graph::FrameInputs& inputs, const Parameters& parameters);

/// "filter.temporal": the estimate at the view's resolution, and its average over frames.
/// [Smal19 §6.2.1, §7.2]
Signal accumulate(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, graph::ImageRef surfaces,
                  const Splat& splat, const Parameters& parameters);

/// "filter.irradiance" and "filter.direction": the à-trous transform with clipped details; `input` itself
/// without passes. Declares the views of its levels, too.  [Smal19 §7.3]
Signal smooth(graph::GraphBuilder& builder, graph::ImageRef surfaces, const Signal& input,
              const Parameters& parameters);

/// Runs the pass in slices of rows of work groups.
template <class Run>
void execute_by_rows(graph::PassBuilder& pass, std::int64_t rows, Run run) {
    pass.execute_sliced(rows, std::move(run), std::max<std::int64_t>(1, rows / 8));
}

/// The same over the pixels of the view; sets "first_row" in pixels itself.
void compute_by_rows(graph::PassBuilder& pass, const graph::GraphBuilder& builder,
                     const gl::ProgramSource& source, graph::Constants constants);

}  // namespace ir::methods::photon_mapping
