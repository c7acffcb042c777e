#include "renderers/methods/ssdo/passes.h"

#include <algorithm>

#include "renderers/methods/ssdo/host/gather_on_host.h"

namespace ir::methods::ssdo {
namespace {

/// Far below the 65,535 turns after which drivers may stop an invocation's loops; slices grow by themselves.
constexpr int samples_per_dispatch = 16;

graph::ImageRef declare(graph::GraphBuilder& builder, const std::string& key, gl::Format format) {
    return builder.output(key, {.format = format});
}

/// Constants of sky.comp and senders.comp.
struct Gather {
    SampleConstants samples;
    int first_sample, end_sample;
    IR_FIELDS(samples, first_sample, end_sample)
};

/// Runs `shader` over all samples, some at a time; it adds to `sums`, the images that it writes.
void add_samples(graph::PassBuilder& pass, const std::string& shader, const Inputs& inputs,
                 graph::ImageRef senders, const std::vector<std::pair<const char*, graph::ImageRef>>& sums) {
    declare_reads(pass, inputs, senders);
    pass.has_two_bodies();
    for (const auto& [name, image] : sums) pass.writes(name, image);
    const int all = inputs.parameters.samples;
    pass.execute_sliced(
        (all + samples_per_dispatch - 1) / samples_per_dispatch,
        [=](graph::PassContext& context, graph::Slice slice) {
            const auto& program = context.use(with_samples(shader, inputs));
            const auto samples = sample_constants(context.inputs(), inputs);
            const auto shape = context.shape(sums.front().second);
            for (auto i = static_cast<int>(slice.begin); i < static_cast<int>(slice.end); ++i) {
                program.set(
                    Gather{samples, i * samples_per_dispatch, std::min(all, (i + 1) * samples_per_dispatch)});
                program.dispatch(shape.width, shape.height);
                context.barrier();
            }
        },
        1);
}

}  // namespace

float reach_of(const graph::GraphBuilder& builder, const Parameters& parameters) {
    const float step = parameters.step_radius, farthest = parameters.transport.max_distance;
    if (step > 0) return farthest > 0 ? std::min(step, farthest) : step;
    if (farthest > 0) return farthest;
    const auto& bounds = builder.inputs().world->bounds;
    const auto diagonal = glm::length(bounds.max - bounds.min);
    return diagonal > 0 ? diagonal : 1.0f;  // without triangles there is nothing to reach
}

Sky gather_sky(graph::GraphBuilder& builder, const Inputs& inputs) {
    const Sky sky{declare(builder, "ssdo.sky.raw", gl::Format::rgba32f),
                  declare(builder, "ssdo.accessibility", gl::Format::r32f),
                  declare(builder, "ssdo.cut", gl::Format::r32f)};
    if (builder.inputs().processor == Processor::host) {
        gather_sky_on_host(builder, inputs, sky);
        return sky;
    }
    auto pass = builder.pass("directional occlusion");
    add_samples(pass, "methods/ssdo/sky.comp", inputs, {},
                {{"sky", sky.raw}, {"accessibility", sky.accessibility}, {"cut", sky.cut}});
    return sky;
}

graph::ImageRef gather_indirect(graph::GraphBuilder& builder, const Inputs& inputs, graph::ImageRef senders) {
    const auto raw = declare(builder, "ssdo.indirect.raw", gl::Format::rgba32f);
    if (builder.inputs().processor == Processor::host) {
        gather_indirect_on_host(builder, inputs, senders, raw);
        return raw;
    }
    auto pass = builder.pass("indirect light");
    add_samples(pass, "methods/ssdo/senders.comp", inputs, senders, {{"indirect", raw}});
    return raw;
}

std::vector<OutputDescription> gathered_outputs() {
    return {
        {.key = "ssdo.indirect.raw",
         .label = "Indirect light before the blur",
         .semantic = Semantic::radiance,
         .unit = "W/(m² sr)",
         .doc = "Reflected to the eye of what each pixel's own samples met. A: how many occluders sent."},
        {.key = "ssdo.sky.raw",
         .label = "Environment light before the blur",
         .semantic = Semantic::radiance,
         .unit = "W/(m² sr)",
         .doc = "Reflected to the eye of the environment that each pixel's own samples saw.",
         .active_when = by_occlusion},
        {.key = "ssdo.accessibility",
         .label = "Accessibility",
         .semantic = Semantic::accessibility,
         .doc =
             "Cosine-weighted fraction of the samples that no surface of the picture hides. Where occluders "
             "are thick it tends to visibility that grows linearly with their distance, up to the radius."},
        {.key = "ssdo.cut",
         .label = "Cut off by the picture's edge",
         .semantic = Semantic::probability,
         .doc =
             "Fraction of the samples that ended outside of the picture: nothing there occludes or sends."},
    };
}

passes::bounce::Receivers receivers_of(const Inputs& inputs) {
    passes::bounce::DirectionOptions options;
    options.parameters.min_roughness = 0;
    options.light = true;
    options.materials = inputs.parameters.transport.materials;
    return {inputs.scene, inputs.gbuffer, options};
}

void declare_reads(graph::PassBuilder& pass, const Inputs& inputs, graph::ImageRef senders) {
    receivers_of(inputs).declare_reads(pass);
    pass.reads("environment_texture", inputs.environment).reads("senders_texture", senders);
    if (!inputs.hidden) return;
    pass.reads(inputs.hidden->positions, inputs.hidden->normals);
    if (senders.index >= 0) pass.reads(inputs.hidden->senders);
}

gl::ProgramSource with_samples(const std::string& shader, const Inputs& inputs) {
    gl::ProgramSource source{{shader}};
    receivers_of(inputs).define(source);
    source.defines.erase("LIGHT");  // samples.glsl says so itself
    source.defines["LAYERS"] = std::to_string(inputs.parameters.layers);
    return source;
}

SampleConstants sample_constants(const graph::FrameInputs& frame, const Inputs& inputs) {
    return {receivers_of(inputs).constants(frame), passes::pixel_rays(frame.view),
            passes::pixel_from_world(frame.view), inputs.reach, static_cast<unsigned>(frame.seed)};
}

}  // namespace ir::methods::ssdo
