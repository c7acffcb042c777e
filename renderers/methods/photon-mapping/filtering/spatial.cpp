#include <algorithm>
#include <array>

#include "renderers/methods/photon-mapping/filtering/stages.h"

namespace ir::methods::photon_mapping {
namespace {

struct Step {
    int index = 0;
    bool is_first = true, is_last = true;
    graph::ImageRef surfaces;
    Signal from, to, sum;
};

struct View {
    const char* key;
    const char* define;
    bool has_input;  ///< layer 0 is what the transform starts from
};
constexpr std::array views{View{"filter.scaling", "SCALING", true}, View{"filter.detail", "DETAIL", false},
                           View{"filter.clipped", "CLIPPED", false}, View{"filter.bound", "BOUND", false}};

/// Rows of groups that cover the view: those of a block of group_size · stride pixels take turns.
std::int64_t covering_groups(int pixels, int stride) {
    const int block = group_size * stride;
    return std::int64_t{1} * (pixels + block - 1) / block * stride;
}

/// Constants of a_trous.comp.
struct ATrous {
    Edges edges;
    float detail_clip;
    int pixel_stride, layer;  ///< layer: of views
    int first_row;            ///< of groups
    IR_FIELDS(edges, detail_clip, pixel_stride, layer, first_row)
};

void compute_step(graph::PassBuilder& pass, const graph::GraphBuilder& builder, const Step& step,
                  const Parameters& parameters, std::map<std::string, std::string> defines, int layer = 0) {
    if (parameters.filter_kernel == FilterKernel::b3_spline) defines["B3_SPLINE"] = "1";
    const auto& inputs = builder.inputs();
    const int stride = 1 << step.index;
    const auto width = covering_groups(inputs.view.width, stride) * group_size;
    const gl::ProgramSource source{{folder + "a_trous.comp"}, defines};
    ATrous constants{.edges = edges(inputs, parameters),
                     .detail_clip = parameters.detail_clip,
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

graph::ResourceText scratch(const std::string& key, const std::string& label, const std::string& doc) {
    return {key, label, doc + " A: x of the direction.", Semantic::irradiance, "W/m²"};
}

void declare_step(graph::GraphBuilder& builder, const Step& step, const Parameters& parameters) {
    auto pass = builder.pass("à-trous " + std::to_string(step.index + 1));
    pass.reads("value_image", step.from.value)
        .reads("direction_image", step.from.direction)
        .reads("surfaces", step.surfaces)
        .writes("value_sum", step.sum.value)
        .writes("direction_sum", step.sum.direction);
    if (!step.is_last) pass.writes("next_value", step.to.value).writes("next_direction", step.to.direction);
    std::map<std::string, std::string> defines;
    if (step.is_first) defines["FIRST"] = "1";
    if (step.is_last) defines["LAST"] = "1";
    compute_step(pass, builder, step, parameters, defines);
}

void declare_view(graph::GraphBuilder& builder, const Step& step, const Parameters& parameters,
                  const std::string& name, graph::ImageRef stack, int layer, const std::string& shown) {
    auto pass = builder.pass(name + ' ' + std::to_string(layer));
    pass.reads("value_image", step.from.value)
        .reads("direction_image", step.from.direction)
        .reads("surfaces", step.surfaces)
        .writes("view", stack);
    compute_step(pass, builder, step, parameters, {{"VIEW", shown}}, layer);
}

class LevelViews {
  public:
    LevelViews(graph::GraphBuilder& builder, const Parameters& parameters)
        : builder_(builder), parameters_(parameters) {
        for (std::size_t i = 0; i < views.size(); ++i) {
            const int layers = parameters.filter_passes + (views[i].has_input ? 1 : 0);
            if (layers > 0) stacks_[i] = builder.output(views[i].key, {.layers = layers});
        }
    }
    /// Before the step overwrites what its predecessor left.
    void show(const Step& step) {
        for (std::size_t i = 0; i < views.size(); ++i)
            declare_view(builder_, step, parameters_, views[i].key, stacks_[i],
                         step.index + (views[i].has_input ? 1 : 0), views[i].define);
    }
    void show_input(const Step& step) {
        declare_view(builder_, step, parameters_, views[0].key, stacks_[0], 0, "INPUT");
    }

  private:
    graph::GraphBuilder& builder_;
    const Parameters& parameters_;
    std::array<graph::ImageRef, views.size()> stacks_;
};

}  // namespace

Signal smooth(graph::GraphBuilder& builder, graph::ImageRef surfaces, const Signal& input,
              const Parameters& parameters) {
    const int passes = parameters.filter_passes;
    LevelViews views(builder, parameters);
    Step step;
    step.surfaces = surfaces;
    step.from = input;
    views.show_input(step);
    if (passes == 0) return input;
    step.sum =
        declare_signal(builder, scratch("filter.irradiance", "Filtered irradiance", "After all filters."));
    std::array<Signal, 2> levels;
    const char* const names[] = {"filter.odd_level", "filter.even_level"};
    for (int i = 0; i < std::min(2, passes - 1); ++i)
        levels[i] =
            declare_signal(builder, scratch(names[i], "Level of the transform", "Overwritten in turns."));
    for (int i = 0; i < passes; ++i) {
        step.index = i;
        step.is_first = i == 0, step.is_last = i == passes - 1;
        step.to = levels[i % 2];
        views.show(step);
        declare_step(builder, step, parameters);
        step.from = step.to;
    }
    return step.sum;
}

}  // namespace ir::methods::photon_mapping
