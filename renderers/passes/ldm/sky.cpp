#include "renderers/passes/ldm/sky.h"

#include "renderers/graph/pass_context.h"
#include "renderers/passes/ldm/host/trace_on_host.h"
#include "renderers/passes/ldm/regions.h"
#include "renderers/passes/scene/stands_still.h"

namespace ir::passes::ldm {
namespace {

/// Maps of one dispatch: as many as devices have uniforms for.
constexpr std::int64_t sky_maps_together = 8;

/// Constants of sky.glsl.
struct TraceSky {
    FrameConstants frames;
    std::span<const glm::vec4> region_light;
    unsigned first_frame, first_map, map_count;
    float sky_distance;
    bool sky_smooth;
    IR_FIELDS(frames, region_light, first_frame, first_map, map_count, sky_distance, sky_smooth)
};

/// Constants of sky_mean.comp.
struct MeanSky {
    bool continues;
    IR_FIELDS(continues)
};

}  // namespace

OutputDescription sky_output(const Condition& active_when) {
    return {.key = "ldm.sky",
            .label = "Environment light through maps",
            .semantic = Semantic::radiance,
            .unit = "W/(m² sr)",
            .doc =
                "What a white Lambertian surface would reflect of the environment: Σ V cosθ L / Σ cosθ, L "
                "the mean radiance of each direction's region. A: frames in the mean.",
            .active_when = active_when};
}

Sky declare_sky(graph::GraphBuilder& builder, const MapsPointer& maps, const Visibility& visibility) {
    Sky sky;
    sky.visibility = visibility;
    sky.light = builder.output("ldm.sky", {.format = gl::Format::rgba32f});
    sky.sums = builder.image({.text = {.key = "ldm.sky_sums",
                                       .label = "Sums of environment light",
                                       .doc = "Σ V cosθ L and, in A, Σ cosθ."},
                              .format = gl::Format::rgba32f});
    sky.regions = builder.object({.text = {.key = "ldm.regions",
                                           .label = "Light of regions",
                                           .doc = "The environment's mean radiance over the region of each "
                                                  "direction, and of its negative."}});
    builder.pass("light of regions", graph::Queue::cpu)
        .writes(sky.regions)
        .execute([=](graph::PassContext& context) {
            const auto made = std::make_shared<std::vector<glm::vec3>>(region_radiance(
                context.inputs().scene->environment, maps->options.directions, maps->options.rotation));
            context.store(sky.regions, made, made->size() * sizeof(glm::vec3));
        });
    return sky;
}

void trace_sky(graph::GraphBuilder& builder, const GBuffer& gbuffer, const MapsPointer& maps, int batch,
               const Sky& sky, const std::string& shader) {
    auto pass = builder.pass("trace sky" + maps->batch_name(batch));
    reads_maps(pass, *maps);
    if (has_host_body(maps->options)) pass.has_two_bodies();
    pass.reads(sky.regions, gbuffer.position, gbuffer.normal, gbuffer.geometric_normal)
        .writes("sky_sums", sky.sums);
    const auto run = [=](graph::PassContext& context, graph::Slice slice) {
        gl::ProgramSource source{{shader}};
        source.defines = defines_of(context, *maps);
        const auto& program = context.use(source);
        const auto shape = context.shape(sky.sums);
        const auto regions = context.object<std::vector<glm::vec3>>(sky.regions);
        const auto end = std::min<std::int64_t>(slice.end * sky_maps_together, maps->batch_maps(batch));
        for (auto first = slice.begin * sky_maps_together; first < end; first += sky_maps_together) {
            const auto count = std::min(sky_maps_together, end - first);
            const auto frame = maps->first_map(batch) + first;
            std::vector<glm::vec4> light;
            for (auto i = 2 * frame; i < 2 * (frame + count); ++i)
                light.emplace_back(regions->at(static_cast<std::size_t>(i)), 0);
            program.set(TraceSky{.frames = frame_constants(*maps, frame, count),
                                 .region_light = light,
                                 .first_frame = static_cast<unsigned>(frame),
                                 .first_map = static_cast<unsigned>(first),
                                 .map_count = static_cast<unsigned>(count),
                                 .sky_distance = sky.visibility.max_distance,
                                 .sky_smooth = sky.visibility.smooth});
            program.dispatch(shape.width, shape.height);
            context.barrier();
        }
    };
    pass.execute_sliced((maps->batch_maps(batch) + sky_maps_together - 1) / sky_maps_together, run, 1);
}

void finish_sky(graph::GraphBuilder& builder, const Sky& sky, bool progressive) {
    auto pass = builder.pass("sky");
    gl::ProgramSource source{{"passes/ldm/sky_mean.comp"}};
    pass.reads("sums", sky.sums).writes("light", sky.light);
    if (progressive) {
        source.defines["PROGRESSIVE"] = "1";
        pass.reads_previous("previous", sky.light);
    }
    pass.compute(source, sky.light, [](const graph::PassContext& context) {
        return MeanSky{context.has_previous() &&
                       stands_still(context.inputs(), Watched::surfaces_and_lights)};
    });
}

}  // namespace ir::passes::ldm
