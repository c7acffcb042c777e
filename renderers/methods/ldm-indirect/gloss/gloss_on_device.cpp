#include "renderers/core/record.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/ldm-indirect/gloss/gloss.h"
#include "renderers/passes/direct/device/light_rays.h"
#include "renderers/passes/direct/direct_light.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/sampling/point_sequence.h"
#include "renderers/passes/scene/stands_still.h"
#include "shaders/methods/ldm-indirect/gloss/path.glsl.h"

namespace ir::methods::ldm_indirect {
namespace {

const std::string gloss_folder = "methods/ldm-indirect/gloss/";

/// Constants of path.glsl.
struct PathNumbers {
    unsigned seed_low, seed_high, number;
    float share;
    bool is_whole;
    IR_FIELDS(seed_low, seed_high, number, share, is_whole)
};

/// Constants of look.comp.
struct Look {
    bool along_mirror;
    IR_FIELDS(along_mirror)
};

/// Constants of go_on.comp.
struct GoOn {
    unsigned event, events, samples, max_bounces;
    bool continues;
    IR_FIELDS(event, events, samples, max_bounces, continues)
};

/// The paths of a frame: bands of pixels, within them samples, within them events.
class DeviceReflections {
  public:
    DeviceReflections(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                      const Parameters& parameters)
        : parameters_(parameters),
          seed_(passes::mixed(photon_seed(builder.inputs(), parameters))),
          bands_(builder.inputs().view),
          rays_(builder, scene, "gloss", bands_, passes::LightRays::Of::hits,
                passes::extended_light_options(parameters.light, parameters.transport),
                parameters.transport.normal_maps),
          paths_(builder.buffer({.text = {.key = "gloss.path", .label = "Paths of gloss"},
                                 .fields = record_fields<GlossPath>(),
                                 .elements = static_cast<std::uint64_t>(bands_.at_once())})) {}

    void declare(graph::PassBuilder& pass, const passes::GBuffer& gbuffer, const GlossImages& images) const {
        rays_.declare(pass, gbuffer);
        pass.writes("Paths", paths_)
            .writes("radiance_image", images.radiance)
            .writes("distance_image", images.distance)
            .writes(images.error);
        if (parameters_.progressive) pass.reads_previous("radiance_before", images.radiance);
    }

    std::int64_t items() const { return bands_.count() * parameters_.gloss.samples * events(); }

    void run(const graph::PassContext& context, std::int64_t item) const {
        const auto event = static_cast<unsigned>(item % events());
        const auto number = static_cast<unsigned>(item / events() % parameters_.gloss.samples);
        const auto band = bands_[item / events() / parameters_.gloss.samples];
        const PathNumbers numbers{static_cast<unsigned>(seed_), static_cast<unsigned>(seed_ >> 32), number,
                                  highlight_share(context.inputs(), parameters_),
                                  parameters_.transport.paths == Transport::Paths::full};
        if (event == 0)
            rays_.dispatch(context, gloss_folder + "look.comp", band, numbers,
                           passes::viewer(context.inputs().view),
                           Look{parameters_.gloss.kind == Gloss::mirror});
        passes::LightRays::trace_hits(context, band);
        rays_.add_punctual(context, band);
        rays_.add_sample(context, band, seed_ + 1 + event, 0, number);
        auto source = rays_.source(gloss_folder + "go_on.comp");
        if (parameters_.progressive) source.defines["PROGRESSIVE"] = "1";
        rays_.dispatch(context, source, band, numbers, passes::HitNormals{parameters_.transport.normal_maps},
                       constants_of(context, event));
    }

  private:
    std::int64_t events() const { return parameters_.transport.max_bounces + most_mirrors; }

    GoOn constants_of(const graph::PassContext& context, unsigned event) const {
        return {event, static_cast<unsigned>(events()), static_cast<unsigned>(parameters_.gloss.samples),
                static_cast<unsigned>(parameters_.transport.max_bounces),
                parameters_.progressive && context.has_previous() &&
                    passes::stands_still(context.inputs(), passes::Watched::surfaces_and_lights)};
    }

    Parameters parameters_;
    std::uint64_t seed_;
    passes::Bands bands_;
    passes::LightRays rays_;
    graph::BufferRef paths_;
};

}  // namespace

void reflect_on_device(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                       const passes::GBuffer& gbuffer, const GlossImages& images,
                       const Parameters& parameters) {
    const DeviceReflections reflections(builder, scene, parameters);
    auto pass = builder.pass("gloss");
    pass.has_two_bodies();
    reflections.declare(pass, gbuffer, images);
    pass.execute_sliced(
        reflections.items(),
        [=](graph::PassContext& context, graph::Slice slice) {
            if (slice.first) context.clear(images.error);
            for (auto i = slice.begin; i < slice.end; ++i) reflections.run(context, i);
        },
        1);
}

}  // namespace ir::methods::ldm_indirect
