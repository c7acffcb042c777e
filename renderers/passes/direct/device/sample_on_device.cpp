#include "renderers/passes/direct/device/sample_on_device.h"

#include <algorithm>

#include "renderers/passes/direct/device/light_rays.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/sampling/point_sequence.h"
#include "renderers/passes/scene/stands_still.h"

namespace ir::passes {
namespace {

/// Constants of add_group.comp.
struct AddGroup {
    unsigned group, groups, samples_of_group, frame;
    bool stands_still;
    float min_reflectance;
    IR_FIELDS(group, groups, samples_of_group, frame, stands_still, min_reflectance)
};

/// A frame's samples in parts, one after the other: bands of pixels, within them groups, within them samples.
class SampleParts {
  public:
    SampleParts(const Bands& bands, int samples)
        : bands_(bands), samples_(samples), groups_(std::min(samples, max_groups)) {}

    struct SamplePart {
        Band band;
        int group, number, samples_of_group;
    };
    std::int64_t count() const { return bands_.count() * samples_; }
    int groups() const { return groups_; }

    SamplePart operator[](std::int64_t index) const {
        SamplePart part{bands_[index / samples_], 0, static_cast<int>(index % samples_), samples_in(0)};
        while (part.number >= part.samples_of_group) {
            part.number -= part.samples_of_group;
            part.samples_of_group = samples_in(++part.group);
        }
        return part;
    }

  private:
    int samples_in(int group) const { return (samples_ - group + groups_ - 1) / groups_; }

    Bands bands_;
    int samples_, groups_;
};

void run(const graph::PassContext& context, const LightRays& rays, const SampleParts& parts,
         std::int64_t index) {
    const auto part = parts[index];
    const auto& inputs = context.inputs();
    const auto seed = mixed(inputs.seed) + static_cast<std::uint64_t>(inputs.frame);
    rays.add_sample(context, part.band, seed, static_cast<unsigned>(part.group),
                    static_cast<unsigned>(part.number));
    if (part.number + 1 < part.samples_of_group) return;
    rays.dispatch(
        context, "passes/direct/device/add_group.comp", part.band, viewer(inputs.view),
        AddGroup{static_cast<unsigned>(part.group), static_cast<unsigned>(parts.groups()),
                 static_cast<unsigned>(part.samples_of_group), static_cast<unsigned>(inputs.frame),
                 context.has_previous() && passes::stands_still(inputs, Watched::surfaces_and_lights),
                 min_reflectance});
}

}  // namespace

void sample_on_device(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                      const SampledImages& images, const ExtendedLightOptions& options) {
    const Bands bands(builder.inputs().view);
    const SampleParts parts(bands, options.parameters.light_samples);
    const LightRays rays(builder, scene, "direct", bands, LightRays::Of::pixels, options, false);
    auto pass = builder.pass("light samples");
    pass.has_two_bodies();
    rays.declare(pass, gbuffer);
    pass.reads_previous("sums_before", images.sums)
        .reads_previous("ProgressBefore", images.progress)
        .writes("sums", images.sums)
        .writes("Progress", images.progress)
        .writes("unfiltered_image", images.results.unfiltered)
        .writes("variance_image", images.results.variance)
        .writes("even_image", images.even)
        .writes("reflectance_image", images.reflectance);
    pass.execute_sliced(
        parts.count(),
        [=](graph::PassContext& context, graph::Slice slice) {
            for (auto i = slice.begin; i < slice.end; ++i) run(context, rays, parts, i);
        },
        1);
}

}  // namespace ir::passes
