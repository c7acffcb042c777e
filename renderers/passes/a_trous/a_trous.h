#pragma once

#include <functional>
#include <optional>
#include <string>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/gbuffer/pixel_rays.h"

/// The edge-avoiding à-trous filter, which keeps edges of depth and normal.  [Dammertz10]
namespace ir::passes::a_trous {

enum class Kernel { printed, b3_spline };  ///< of the five pixels along a side [Smal19 §7.3; Dammertz10]

struct Options {
    std::string name = "à-trous";  ///< of the passes, before their numbers
    int passes = 4;                ///< pass i, from 0, takes 5 × 5 pixels that are 2^i apart
    Kernel kernel = Kernel::b3_spline;
    float sigma_depth = 1, sigma_normal = 32;  ///< [Smal19 eqs. 7.1, 7.2]
    /// Details come back up to so many standard deviations of their neighbourhood.  [Smal19 §7.3.1]
    float detail_clip = 0;
    /// Dark details come back up to four times γ of the pixel itself at most, so that bright neighbours can
    /// not make black of grey.
    bool bounds_dark_details = false;
    /// Above 0: guided by variance instead, which stands in the fourth channel. Neighbours whose luminance is
    /// so many standard errors away count 1/e.  [Schied17 eq. 5]
    float sigma_value = 0;
    bool is_guided() const { return sigma_value > 0; }
};

/// A picture to be filtered.
struct Signal {
    graph::ImageRef value;  ///< rgba32f
    /// rg32f: two channels more, filtered likewise. Only without a guide.
    std::optional<graph::ImageRef> direction = {};
};

/// One pass of the filter.
struct Step {
    int index = 0;
    bool is_first = true, is_last = true;
    graph::ImageRef surfaces;
    Signal from, to = {}, sum = {};  ///< sum: of clipped details; what the last pass writes
};

/// "filter.surfaces" rg32ui: normal and depth of each pixel, as shaders/passes/a_trous/surface.glsl packs
/// them. Who asks again in a frame gets the same.
graph::ImageRef pack_surfaces(graph::GraphBuilder& builder, const GBuffer& gbuffer);

/// Constants of shaders/passes/a_trous/surface.glsl.
struct Edges {
    PixelRays rays;
    float sigma_depth, sigma_normal;
    IR_FIELDS(rays, sigma_depth, sigma_normal)
};
Edges edges(const graph::FrameInputs& inputs, const Options& options);

/// Declares one image or two. `text` is that of the value.
Signal declare_signal(graph::GraphBuilder& builder, const graph::ResourceText& text, bool has_direction);

/// Declares the passes, all but none, and what lies between them. `result` is what the last one writes, and
/// `levels` names the pictures in between. `before` sees each step before it is declared.
Signal smooth(graph::GraphBuilder& builder, graph::ImageRef surfaces, const Signal& input,
              const graph::ResourceText& result, const graph::ResourceText& levels, const Options& options,
              const std::function<void(const Step&)>& before = {});

/// For a pass that writes layer `layer` of "view", an array, instead of a step's results: what `shown` names
/// in shaders/passes/a_trous/a_trous.comp.
void compute_view(graph::PassBuilder& pass, const graph::GraphBuilder& builder, const Step& step,
                  const Options& options, const std::string& shown, int layer);

/// Extent of the work groups, in both directions, of shaders that compute_by_rows runs.
constexpr int group_size = 16;

/// An invocation for each pixel of the view, in slices of rows of work groups; sets "first_row" in pixels.
void compute_by_rows(graph::PassBuilder& pass, const graph::GraphBuilder& builder,
                     const gl::ProgramSource& source, graph::Constants constants);

}  // namespace ir::passes::a_trous
