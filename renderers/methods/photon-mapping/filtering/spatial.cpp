#include <array>

#include "renderers/methods/photon-mapping/filtering/stages.h"

namespace ir::methods::photon_mapping {
namespace {

struct View {
    const char* key;
    const char* shown;
    bool has_input;  ///< layer 0 is what the transform starts from
};
constexpr std::array views{View{"filter.scaling", "SCALING", true}, View{"filter.detail", "DETAIL", false},
                           View{"filter.clipped", "CLIPPED", false}, View{"filter.bound", "BOUND", false}};

class LevelViews {
  public:
    LevelViews(graph::GraphBuilder& builder, const passes::a_trous::Options& options)
        : builder_(builder), options_(options) {
        for (std::size_t i = 0; i < views.size(); ++i) {
            const int layers = options.passes + (views[i].has_input ? 1 : 0);
            if (layers > 0) stacks_[i] = builder.output(views[i].key, {.layers = layers});
        }
    }
    /// Before the step overwrites what its predecessor left.
    void show(const passes::a_trous::Step& step) {
        for (std::size_t i = 0; i < views.size(); ++i)
            declare(step, i, step.index + (views[i].has_input ? 1 : 0), views[i].shown);
    }
    void show_input(const passes::a_trous::Step& step) { declare(step, 0, 0, "INPUT"); }

  private:
    void declare(const passes::a_trous::Step& step, std::size_t view, int layer, const std::string& shown) {
        auto pass = builder_.pass(views[view].key + (' ' + std::to_string(layer)));
        pass.writes("view", stacks_[view]);
        passes::a_trous::compute_view(pass, builder_, step, options_, shown, layer);
    }

    graph::GraphBuilder& builder_;
    const passes::a_trous::Options& options_;
    std::array<graph::ImageRef, views.size()> stacks_;
};

graph::ResourceText scratch(const std::string& key, const std::string& label, const std::string& doc) {
    return {key, label, doc + " A: x of the direction.", Semantic::irradiance, "W/m²"};
}

}  // namespace

passes::a_trous::Options filter_options(const Parameters& parameters) {
    passes::a_trous::Options options;
    options.passes = parameters.filter_passes;
    options.kernel = parameters.filter_kernel;
    options.sigma_depth = parameters.sigma_depth, options.sigma_normal = parameters.sigma_normal;
    options.detail_clip = parameters.detail_clip;
    options.bounds_dark_details = parameters.bounds_dark_details;
    return options;
}

passes::a_trous::Signal smooth(graph::GraphBuilder& builder, graph::ImageRef surfaces,
                               const passes::a_trous::Signal& input, const Parameters& parameters) {
    const auto options = filter_options(parameters);
    LevelViews views(builder, options);
    views.show_input({.surfaces = surfaces, .from = input});
    if (options.passes == 0) return input;
    return passes::a_trous::smooth(builder, surfaces, input,
                                   scratch("filter.irradiance", "Filtered irradiance", "After all filters."),
                                   scratch("filter", "Level of the transform", "Overwritten in turns."),
                                   options, [&](const passes::a_trous::Step& step) { views.show(step); });
}

}  // namespace ir::methods::photon_mapping
