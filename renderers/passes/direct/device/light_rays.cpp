#include "renderers/passes/direct/device/light_rays.h"

#include <algorithm>

#include "renderers/core/record.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/lights/punctual.h"
#include "shaders/passes/direct/device/samples.glsl.h"

namespace ir::passes {
namespace {

const std::string folder = "passes/direct/device/";

/// What fills a device, and takes 36 MiB; with the rays of hits 48.
constexpr std::int64_t pixels_at_once = 1 << 18;
/// Of rays of light: towards a source, and along a direction of the material.
constexpr std::int64_t light_kinds = 2;

/// Constants of draw.comp.
struct DrawSamples {
    unsigned seed_low, seed_high, group, number;
    bool mirrors, any_hit;
    IR_FIELDS(seed_low, seed_high, group, number, mirrors, any_hit)
};

/// Constants of draw_punctual.comp.
struct DrawPunctual {
    unsigned light;
    bool any_hit;
    IR_FIELDS(light, any_hit)
};

/// Of either kind of surfaces.
struct Surfaces {
    Viewer viewer;
    bool normal_maps;
    IR_FIELDS(viewer, normal_maps)
};

/// Constants of gather.comp.
struct MayPass {
    bool may_pass;
    IR_FIELDS(may_pass)
};

std::vector<unsigned> punctual_lights(const scene::World& world) {
    std::vector<unsigned> numbers;
    for (std::size_t i = 0; i < world.lights.size(); ++i)
        if (is_punctual(world.lights[i])) numbers.push_back(static_cast<unsigned>(i));
    return numbers;
}

void trace_kind(const graph::PassContext& context, const Band& band, std::int64_t kind) {
    const auto first = kind * std::int64_t{band.rays_of_kind};
    DeviceTracer::trace(context, first, first + band.pixels());
}

}  // namespace

Bands::Bands(const scene::View& view)
    : width_(view.width),
      pixels_(std::int64_t{1} * view.width * view.height),
      at_once_(std::min(pixels_, pixels_at_once)) {}

Band Bands::operator[](std::int64_t index) const {
    const auto first = index * at_once_, end = std::min(pixels_, first + at_once_);
    return {static_cast<unsigned>(first), static_cast<unsigned>(end), width_,
            static_cast<unsigned>(at_once_)};
}

LightRays::LightRays(graph::GraphBuilder& builder, const SceneBuffers& scene, const std::string& key,
                     const Bands& bands, Of surfaces, const ExtendedLightOptions& options, bool normal_maps)
    : options_(options),
      of_hits_(surfaces == Of::hits),
      normal_maps_(normal_maps),
      has_panes_(Panes::any_in(builder.inputs().scene->materials, options.materials)),
      scene_(scene),
      tracer_(builder, scene),
      surfaces_(hit_surfaces(builder, scene)) {
    const auto there = extended_sources(builder.inputs(), options);
    is_sampled_ = there.any() && options.parameters.light_samples > 0;
    if (of_hits_) punctual_ = punctual_lights(*builder.inputs().world);
    sources_ = source_buffers(builder, options.environment, there.emissive_triangles);
    const auto at_once = static_cast<std::uint64_t>(bands.at_once());
    rays_ = declare_rays(builder, key, (light_kinds + (of_hits_ ? 1 : 0)) * at_once);
    paths_ = builder.buffer({.text = {.key = key + ".paths", .label = "What rays carry of the direct light"},
                             .fields = record_fields<LightPathRecord>(),
                             .elements = light_kinds * at_once});
    group_ = builder.buffer({.text = {.key = key + ".group", .label = "Direct light of a group of samples"},
                             .fields = {{"light", graph::FieldType::f32, 4}},
                             .elements = at_once,
                             .cleared = true});
    if (of_hits_)
        spreads_ = builder.buffer({.text = {.key = key + ".spreads",
                                            .label = "Directions that rays stand for",
                                            .doc = "As wide as they are, highlights are that they meet.",
                                            .unit = "sr"},
                                   .fields = {{"spread", graph::FieldType::f32}},
                                   .elements = at_once});
}

void LightRays::declare(graph::PassBuilder& pass, const GBuffer& gbuffer) const {
    tracer_.declare_reads(pass);
    pass.reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal, gbuffer.albedo, gbuffer.material)
        .reads("Materials", scene_.materials)
        .writes("Rays", rays_.rays)
        .writes("Hits", rays_.hits)
        .writes("GroupLight", group_);
    if (of_hits_ || has_panes_)
        surfaces_.read_by(pass);
    else
        pass.reads(surfaces_.texels);
    if (of_hits_) pass.writes("Spreads", spreads_);
    if (!punctual_.empty()) pass.reads("Lights", scene_.lights);
    if (!is_sampled_ && punctual_.empty()) return;
    sources_.read_by(pass);
    pass.reads("EmissiveNumbers", sources_.numbers).writes("LightPaths", paths_);
}

gl::ProgramSource LightRays::source(const std::string& file) const {
    gl::ProgramSource source{{file}};
    source.defines["MATERIALS"] = std::to_string(static_cast<int>(options_.materials));
    if (of_hits_) source.defines["HITS"] = "1";
    return source;
}

void LightRays::add_sample(const graph::PassContext& context, const Band& band, std::uint64_t seed,
                           unsigned group, unsigned number) const {
    if (!is_sampled_) return;
    const DrawSamples constants{static_cast<unsigned>(seed),
                                static_cast<unsigned>(seed >> 32),
                                group,
                                number,
                                options_.mirrors,
                                !has_panes_};
    dispatch(context, folder + "draw.comp", band, constants,
             Surfaces{viewer(context.inputs().view), normal_maps_});
    trace_and_gather(context, band, light_kinds);
}

void LightRays::add_punctual(const graph::PassContext& context, const Band& band) const {
    for (const auto light : punctual_) {
        dispatch(context, folder + "draw_punctual.comp", band, DrawPunctual{light, !has_panes_},
                 HitNormals{normal_maps_});
        trace_and_gather(context, band, 1);  // towards the light alone
    }
}

void LightRays::trace_hits(const graph::PassContext& context, const Band& band) {
    trace_kind(context, band, light_kinds);
    context.barrier();
}

void LightRays::trace_and_gather(const graph::PassContext& context, const Band& band,
                                 std::int64_t kinds) const {
    auto program = source(folder + "gather.comp");
    if (has_panes_) program.defines["PANES"] = "1";
    const int segments = has_panes_ ? max_panes + 1 : 1;
    for (int i = 0; i < segments; ++i) {
        for (std::int64_t kind = 0; kind < kinds; ++kind) trace_kind(context, band, kind);
        context.barrier();
        dispatch(context, program, band, Surfaces{viewer(context.inputs().view), normal_maps_},
                 MayPass{i + 1 < segments});
    }
}

}  // namespace ir::passes
