#include "renderers/passes/a_trous/a_trous.h"

#include <algorithm>
#include <array>
#include <map>

#include "renderers/passes/a_trous/host/a_trous_on_host.h"

namespace ir::passes::a_trous {
namespace {

const std::string folder = "passes/a_trous/";

/// Of the dispatch of a slice.
struct FirstRow {
    int first_row;
    IR_FIELDS(first_row)
};

/// Constants of surfaces.comp.
struct PackSurfaces {
    glm::vec4 depth_row;
    IR_FIELDS(depth_row)
};

/// Constants of a_trous.comp.
struct ATrous {
    Edges edges;
    float detail_clip, sigma_value;
    int pixel_stride, layer;  ///< layer: of views
    int first_row;            ///< of groups
    IR_FIELDS(edges, detail_clip, sigma_value, pixel_stride, layer, first_row)
};

/// Runs the pass in slices of rows of work groups.
template <class Run>
void execute_by_rows(graph::PassBuilder& pass, std::int64_t rows, Run run) {
    pass.execute_sliced(rows, std::move(run), std::max<std::int64_t>(1, rows / 8));
}

/// Rows of groups that cover the view: those of a block of group_size · stride pixels take turns.
std::int64_t covering_groups(int pixels, int stride) {
    const int block = group_size * stride;
    return std::int64_t{1} * (pixels + block - 1) / block * stride;
}

void read_step(graph::PassBuilder& pass, const Step& step) {
    pass.reads("value_image", step.from.value).reads("surfaces", step.surfaces);
    if (step.from.direction) pass.reads("direction_image", *step.from.direction);
}

void compute_step(graph::PassBuilder& pass, const graph::GraphBuilder& builder, const Step& step,
                  const Options& options, std::map<std::string, std::string> defines, int layer = 0) {
    if (options.kernel == Kernel::b3_spline) defines["B3_SPLINE"] = "1";
    if (options.bounds_dark_details) defines["BOUNDS_DARK_DETAILS"] = "1";
    if (options.is_guided()) defines["GUIDED"] = "1";
    const auto& inputs = builder.inputs();
    const int stride = 1 << step.index;
    const auto width = covering_groups(inputs.view.width, stride) * group_size;
    const gl::ProgramSource source{{folder + "a_trous.comp"}, defines};
    ATrous constants{.edges = edges(inputs, options),
                     .detail_clip = options.detail_clip,
                     .sigma_value = options.sigma_value,
                     .pixel_stride = stride,
                     .layer = layer,
                     .first_row = 0};
    execute_by_rows(pass, covering_groups(inputs.view.height, stride),
                    [=](graph::PassContext& context, graph::Slice slice) mutable {
                        const auto& program = context.use(source);
                        constants.first_row = static_cast<int>(slice.begin);
                        program.set(constants);
                        program.dispatch(width, (slice.end - slice.begin) * group_size);
                    });
}

/// Details are summed in the result; with a guide there are none, and the last pass alone writes it.
void declare_clipped_step(graph::GraphBuilder& builder, const Step& step, const Options& options,
                          const std::string& name) {
    auto pass = builder.pass(name);
    pass.has_two_bodies();
    read_step(pass, step);
    pass.writes("value_sum", step.sum.value).writes("direction_sum", *step.sum.direction);
    if (!step.is_last) pass.writes("next_value", step.to.value).writes("next_direction", *step.to.direction);
    std::map<std::string, std::string> defines;
    if (step.is_first) defines["FIRST"] = "1";
    if (step.is_last) defines["LAST"] = "1";
    compute_step(pass, builder, step, options, defines);
}

void declare_guided_step(graph::GraphBuilder& builder, const Step& step, const Options& options,
                         const std::string& name) {
    auto pass = builder.pass(name);
    pass.has_two_bodies();
    read_step(pass, step);
    pass.writes("next_value", step.is_last ? step.sum.value : step.to.value);
    compute_step(pass, builder, step, options, {});
}

graph::ResourceText numbered(graph::ResourceText text, const char* which) {
    text.key += which;
    return text;
}

}  // namespace

void compute_by_rows(graph::PassBuilder& pass, const graph::GraphBuilder& builder,
                     const gl::ProgramSource& source, graph::Constants constants) {
    const auto rows = (builder.inputs().view.height + group_size - 1) / group_size;
    execute_by_rows(pass, rows, [=](graph::PassContext& context, graph::Slice slice) {
        const auto& program = context.use(source);
        constants.give(context, program);
        program.set(FirstRow{static_cast<int>(slice.begin) * group_size});
        program.dispatch(context.inputs().view.width, (slice.end - slice.begin) * group_size);
    });
}

Edges edges(const graph::FrameInputs& inputs, const Options& options) {
    return {pixel_rays(inputs.view), options.sigma_depth, options.sigma_normal};
}

Signal declare_signal(graph::GraphBuilder& builder, const graph::ResourceText& text, bool has_direction) {
    Signal signal{builder.image({.text = text, .format = gl::Format::rgba32f})};
    if (!has_direction) return signal;
    const graph::ResourceText direction{
        text.key + "_direction", text.label + ": direction",
        "y and z of the sum of directions to the light, weighted by R + G + B"};
    signal.direction = builder.image({.text = direction, .format = gl::Format::rg32f});
    return signal;
}

graph::ImageRef pack_surfaces(graph::GraphBuilder& builder, const GBuffer& gbuffer) {
    graph::ImageDesc desc;
    desc.text = {"filter.surfaces", "Packed surfaces", packed_surface_doc};
    for (std::size_t i = 0; i < builder.images().size(); ++i)
        if (builder.images()[i].text.key == desc.text.key) return {static_cast<int>(i)};
    desc.format = gl::Format::rg32ui;
    const auto result = builder.image(desc);
    auto pass = builder.pass("filter surfaces");
    pass.reads(gbuffer.position, gbuffer.geometric_normal).writes("surfaces", result);
    compute_by_rows(pass, builder, {{folder + "surfaces.comp"}},
                    PackSurfaces{-glm::transpose(builder.inputs().view.view_from_world)[2]});
    return result;
}

void compute_view(graph::PassBuilder& pass, const graph::GraphBuilder& builder, const Step& step,
                  const Options& options, const std::string& shown, int layer) {
    read_step(pass, step);
    compute_step(pass, builder, step, options, {{"VIEW", shown}}, layer);
}

Signal smooth(graph::GraphBuilder& builder, graph::ImageRef surfaces, const Signal& input,
              const graph::ResourceText& result, const graph::ResourceText& levels, const Options& options,
              const std::function<void(const Step&)>& before) {
    Step step;
    step.surfaces = surfaces;
    step.from = input;
    const bool has_direction = input.direction.has_value();
    step.sum = declare_signal(builder, result, has_direction);
    std::array<Signal, 2> between;
    const char* const names[] = {".odd_level", ".even_level"};
    for (int i = 0; i < std::min(2, options.passes - 1); ++i)
        between[i] = declare_signal(builder, numbered(levels, names[i]), has_direction);
    for (int i = 0; i < options.passes; ++i) {
        step.index = i;
        step.is_first = i == 0, step.is_last = i == options.passes - 1;
        step.to = between[i % 2];
        if (before) before(step);
        const auto name = options.name + ' ' + std::to_string(i + 1);
        if (builder.inputs().processor == Processor::host)
            filter_on_host(builder, step, options, name);
        else if (options.is_guided())
            declare_guided_step(builder, step, options, name);
        else
            declare_clipped_step(builder, step, options, name);
        step.from = step.to;
    }
    return step.sum;
}

}  // namespace ir::passes::a_trous
