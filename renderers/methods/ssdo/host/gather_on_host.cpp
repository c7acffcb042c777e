#include "renderers/methods/ssdo/host/gather_on_host.h"

#include <algorithm>

#include "renderers/core/parallel_for.h"
#include "renderers/methods/ssdo/host/gather_rows.h"
#include "renderers/passes/bounce/host/host_receivers.h"
#include "renderers/passes/sampling/pattern_shift.h"
#include "renderers/passes/sampling/pcg.h"
#include "renderers/passes/scattering/microfacets.h"

namespace ir::methods::ssdo {
namespace {

void put(PointRow::Planes& planes, std::size_t at, glm::vec3 value) {
    for (int c = 0; c < 3; ++c) planes[static_cast<std::size_t>(c)][at] = value[c];
}

glm::vec3 shift_of(const Picture& picture, int x, int y) {
    if (picture.parameters.turning == Turning::none) return glm::vec3(0.5f);
    if (picture.parameters.turning == Turning::pattern) return passes::pattern_shift({x, y});
    const auto bits = passes::pcg3d(glm::uvec3(x, y, picture.constants.seed));
    return {passes::unit_float(bits.x), passes::unit_float(bits.y), passes::unit_float(bits.z)};
}

/// A frame's pixels.
class Gathering {
  public:
    Gathering(const graph::PassContext& context, const Inputs& inputs, graph::ImageRef senders)
        : receivers_(context, receivers_of(inputs)),
          picture_{.constants = sample_constants(context.inputs(), inputs),
                   .parameters = inputs.parameters,
                   .width = context.inputs().view.width,
                   .height = context.inputs().view.height} {
        const bool has_senders = senders.index >= 0;
        picture_.layers.push_back({context.pixels<const glm::vec4>(inputs.gbuffer.position),
                                   context.pixels<const glm::vec4>(inputs.gbuffer.geometric_normal)});
        if (has_senders)
            picture_.layers[0].senders = context.pixels<const glm::vec4>(senders);
        else
            picture_.environment = context.pixels<const glm::vec4>(inputs.environment);
        for (int i = 0; inputs.hidden && i + 1 < inputs.parameters.layers; ++i) {
            picture_.layers.push_back({context.pixels<const glm::vec4>(inputs.hidden->positions, i),
                                       context.pixels<const glm::vec4>(inputs.hidden->normals, i)});
            if (has_senders)
                picture_.layers.back().senders = context.pixels<const glm::vec4>(inputs.hidden->senders, i);
        }
    }

    const Picture& picture() const { return picture_; }

    PointRow row(int y) const {
        PointRow row(picture_.width);
        for (int x = 0; x < picture_.width; ++x) fill(row, x, y);
        return row;
    }

    template <class T>
    std::span<T> row_of(std::span<T> image, std::int64_t y) const {
        const auto width = static_cast<std::size_t>(picture_.width);
        return image.subspan(static_cast<std::size_t>(y) * width, width);
    }

  private:
    /// point_at of samples.glsl.
    void fill(PointRow& row, int x, int y) const {
        const auto at = static_cast<std::size_t>(x);
        const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) + at;
        const auto receiver = receivers_.at(pixel);
        if (!receiver) return;
        row.exists[at] = 1;
        put(row.position, at, receiver->position);
        put(row.normal, at, receiver->normal);
        put(row.geometric_normal, at, receiver->geometric_normal);
        put(row.shift, at, shift_of(picture_, x, y));
        const auto s = receivers_.scatterer_at(pixel, *receiver);
        if (!s) return;
        row.is_lit[at] = 1;
        put(row.viewer, at, s->viewer);
        put(row.diffuse, at, s->lobes.diffuse);
        put(row.f0, at, s->lobes.f0);
        row.n_dot_v[at] = std::max(s->n_dot_v, passes::min_view_cosine);
        const float alpha = s->roughness * s->roughness;
        const bool is_mirror = alpha < passes::mirror_alpha;
        row.alpha[at] = is_mirror ? 1 : alpha;
        row.specular[at] = is_mirror ? 0 : s->lobes.specular;
    }

    passes::bounce::HostReceivers receivers_;
    Picture picture_;
};

/// Rows of a picture in slices; `gather` is called with a Gathering, its PointRow, the context and y.
template <class Gather>
void gather_rows(graph::GraphBuilder& builder, graph::PassBuilder& pass, const Inputs& inputs,
                 graph::ImageRef senders, const Gather& gather) {
    passes::bounce::HostReceivers::declare_reads(pass, receivers_of(inputs));
    if (inputs.hidden) {
        pass.reads(inputs.hidden->positions, inputs.hidden->normals);
        if (senders.index >= 0) pass.reads(inputs.hidden->senders);
    }
    pass.has_two_bodies().execute_sliced(
        builder.inputs().view.height, [=](graph::PassContext& context, graph::Slice slice) {
            const Gathering gathering(context, inputs, senders);
            parallel_for(context.inputs().threads, slice.begin, slice.end, [&](std::int64_t y) {
                gather(context, gathering, gathering.row(static_cast<int>(y)), y);
            });
        });
}

}  // namespace

void gather_sky_on_host(graph::GraphBuilder& builder, const Inputs& inputs, const Sky& sky) {
    auto pass = builder.pass("directional occlusion", graph::Queue::cpu);
    pass.reads(inputs.environment).writes(sky.raw, sky.accessibility, sky.cut);
    gather_rows(builder, pass, inputs, {},
                [=](graph::PassContext& context, const Gathering& all, const PointRow& row, std::int64_t y) {
                    gather_sky(all.picture(), row, all.row_of(context.pixels<glm::vec4>(sky.raw), y),
                               all.row_of(context.pixels<float>(sky.accessibility), y),
                               all.row_of(context.pixels<float>(sky.cut), y));
                });
}

void gather_indirect_on_host(graph::GraphBuilder& builder, const Inputs& inputs, graph::ImageRef senders,
                             graph::ImageRef raw) {
    auto pass = builder.pass("indirect light", graph::Queue::cpu);
    pass.reads(senders).writes(raw);
    gather_rows(builder, pass, inputs, senders,
                [=](graph::PassContext& context, const Gathering& all, const PointRow& row, std::int64_t y) {
                    gather_indirect(all.picture(), row, all.row_of(context.pixels<glm::vec4>(raw), y));
                });
}

}  // namespace ir::methods::ssdo
