#include "renderers/passes/direct/device/sample_on_device.h"

#include <algorithm>
#include <string>

#include "renderers/core/record.h"
#include "renderers/gl/dispatch_items.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/lights/device/source_buffers.h"
#include "renderers/passes/raytracing/trace_rays.h"
#include "renderers/passes/sampling/point_sequence.h"
#include "renderers/passes/scene/hit_surfaces.h"
#include "renderers/passes/scene/stands_still.h"
#include "shaders/passes/direct/device/samples.glsl.h"

namespace ir::passes {
namespace {

const std::string sample_folder = "passes/direct/device/";

/// Of which a sample is drawn at once: what fills a device, and takes 36 MiB.
constexpr std::int64_t pixels_at_once = 1 << 18;

/// A part of the work: a sample of the pixels [first, end).
struct Band {
    unsigned first_pixel, end_pixel;
    int width;
    unsigned rays_of_kind;
    IR_FIELDS(first_pixel, end_pixel, width, rays_of_kind)
};

/// Constants of draw.comp.
struct DrawSamples {
    Band band;
    Viewer viewer;
    unsigned seed_low, seed_high, group, number;
    bool mirrors, any_hit;
    IR_FIELDS(band, viewer, seed_low, seed_high, group, number, mirrors, any_hit)
};

/// Constants of gather.comp.
struct GatherSamples {
    Band band;
    IR_FIELDS(band)
};
struct GatherThroughPanes {
    Band band;
    bool may_pass;
    IR_FIELDS(band, may_pass)
};

/// Constants of add_group.comp.
struct AddGroup {
    Band band;
    unsigned group, groups, samples_of_group, frame;
    bool stands_still;
    float min_reflectance;
    IR_FIELDS(band, group, groups, samples_of_group, frame, stands_still, min_reflectance)
};

/// A frame's samples in parts, one after the other: bands of pixels, within them groups, within them samples.
class SampleParts {
  public:
    SampleParts(const scene::View& view, int samples)
        : width_(view.width),
          pixels_(std::int64_t{1} * view.width * view.height),
          samples_(samples),
          groups_(std::min(samples, max_groups)) {}

    struct SamplePart {
        Band band;
        int group, number, samples_of_group;
    };
    std::int64_t count() const { return (pixels_ + at_once() - 1) / at_once() * samples_; }
    std::int64_t at_once() const { return std::min(pixels_, pixels_at_once); }
    int groups() const { return groups_; }

    SamplePart operator[](std::int64_t index) const {
        const auto first = index / samples_ * at_once(), end = std::min(pixels_, first + at_once());
        SamplePart part{{static_cast<unsigned>(first), static_cast<unsigned>(end), width_,
                         static_cast<unsigned>(at_once())},
                        0,
                        static_cast<int>(index % samples_),
                        samples_in(0)};
        while (part.number >= part.samples_of_group) {
            part.number -= part.samples_of_group;
            part.samples_of_group = samples_in(++part.group);
        }
        return part;
    }

  private:
    int samples_in(int group) const { return (samples_ - group + groups_ - 1) / groups_; }

    int width_;
    std::int64_t pixels_;
    int samples_, groups_;
};

/// What the pass knows of the frame when it is declared.
class DeviceSampling {
  public:
    DeviceSampling(const graph::FrameInputs& inputs, const ExtendedLightOptions& options)
        : parts_(inputs.view, options.parameters.light_samples), options_(options) {
        has_panes_ = Panes::any_in(inputs.scene->materials, options.materials);
    }

    const SampleParts& parts() const { return parts_; }
    bool has_panes() const { return has_panes_; }

    void run(const graph::PassContext& context, std::int64_t index) const {
        const auto part = parts_[index];
        draw(context, part);
        const int segments = has_panes_ ? max_panes + 1 : 1;
        for (int i = 0; i < segments; ++i) {
            trace(context, part.band);
            gather(context, part.band, i + 1 < segments);
        }
        if (part.number + 1 == part.samples_of_group) add_group(context, part);
    }

  private:
    gl::ProgramSource source(const std::string& file) const {
        gl::ProgramSource source{{sample_folder + file}};
        source.defines["MATERIALS"] = std::to_string(static_cast<int>(options_.materials));
        if (has_panes_ && file == "gather.comp") source.defines["PANES"] = "1";
        return source;
    }
    template <class T>
    void dispatch(const graph::PassContext& context, const std::string& file, const T& constants) const {
        const auto& program = context.use(source(file));
        program.set(constants);
        program.dispatch(constants.band.end_pixel - constants.band.first_pixel);
        context.barrier();
    }

    void draw(const graph::PassContext& context, const SampleParts::SamplePart& part) const {
        const auto& inputs = context.inputs();
        const auto seed = mixed(inputs.seed) + static_cast<std::uint64_t>(inputs.frame);
        dispatch(context, "draw.comp",
                 DrawSamples{part.band, viewer(inputs.view), static_cast<std::uint32_t>(seed),
                             static_cast<std::uint32_t>(seed >> 32), static_cast<unsigned>(part.group),
                             static_cast<unsigned>(part.number), options_.mirrors, !has_panes_});
    }

    static void trace(const graph::PassContext& context, const Band& band) {
        const auto pixels = static_cast<std::int64_t>(band.end_pixel - band.first_pixel),
                   drawn = static_cast<std::int64_t>(band.rays_of_kind);
        DeviceTracer::trace(context, 0, pixels);
        DeviceTracer::trace(context, drawn, drawn + pixels);
        context.barrier();
    }

    void gather(const graph::PassContext& context, const Band& band, bool may_pass) const {
        if (has_panes_)
            dispatch(context, "gather.comp", GatherThroughPanes{band, may_pass});
        else
            dispatch(context, "gather.comp", GatherSamples{band});
    }

    void add_group(const graph::PassContext& context, const SampleParts::SamplePart& part) const {
        const auto& inputs = context.inputs();
        dispatch(
            context, "add_group.comp",
            AddGroup{part.band, static_cast<unsigned>(part.group), static_cast<unsigned>(parts_.groups()),
                     static_cast<unsigned>(part.samples_of_group), static_cast<unsigned>(inputs.frame),
                     context.has_previous() && passes::stands_still(inputs, Watched::surfaces_and_lights),
                     min_reflectance});
    }

    SampleParts parts_;
    ExtendedLightOptions options_;
    bool has_panes_ = false;
};

}  // namespace

void sample_on_device(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                      const SampledImages& images, const ExtendedLightOptions& options) {
    const DeviceSampling sampling(builder.inputs(), options);
    const auto sources = source_buffers(
        builder,
        {.punctual = false, .environment = options.environment, .emissive_meshes = options.emissive_meshes},
        extended_sources(builder.inputs(), options).emissive_triangles);
    const auto surfaces = hit_surfaces(builder, scene);
    const auto at_once = sampling.parts().at_once();
    const auto rays = declare_rays(builder, "direct", static_cast<std::uint64_t>(2 * at_once));
    const auto paths =
        builder.buffer({.text = {.key = "direct.paths", .label = "What rays carry of the direct light"},
                        .fields = record_fields<LightPathRecord>(),
                        .elements = static_cast<std::uint64_t>(2 * at_once)});
    const auto group =
        builder.buffer({.text = {.key = "direct.group", .label = "Direct light of a group of samples"},
                        .fields = {{"light", graph::FieldType::f32, 4}},
                        .elements = static_cast<std::uint64_t>(at_once),
                        .cleared = true});
    const DeviceTracer tracer(builder, scene);
    auto pass = builder.pass("light samples");
    pass.has_two_bodies();
    sources.read_by(pass);
    tracer.declare_reads(pass);
    pass.reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal, gbuffer.albedo, gbuffer.material)
        .reads("Materials", scene.materials)
        .reads("EmissiveNumbers", sources.numbers)
        .reads_previous("sums_before", images.sums)
        .reads_previous("ProgressBefore", images.progress)
        .writes("Rays", rays.rays)
        .writes("Hits", rays.hits)
        .writes("LightPaths", paths)
        .writes("GroupLight", group)
        .writes("sums", images.sums)
        .writes("Progress", images.progress)
        .writes("unfiltered_image", images.results.unfiltered)
        .writes("variance_image", images.results.variance)
        .writes("even_image", images.even)
        .writes("reflectance_image", images.reflectance);
    if (sampling.has_panes())
        surfaces.read_by(pass);
    else
        pass.reads(surfaces.texels);
    pass.execute_sliced(
        sampling.parts().count(),
        [=](graph::PassContext& context, graph::Slice slice) {
            for (auto i = slice.begin; i < slice.end; ++i) sampling.run(context, i);
        },
        1);
}

}  // namespace ir::passes
