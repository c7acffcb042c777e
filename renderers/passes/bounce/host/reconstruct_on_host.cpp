#include "renderers/passes/bounce/host/reconstruct_on_host.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "renderers/core/threads.h"
#include "renderers/graph/image_layers.h"
#include "renderers/passes/bounce/host/filter_tile.h"
#include "renderers/passes/bounce/host/host_receivers.h"
#include "renderers/passes/lights/luminance.h"
#include "renderers/passes/scattering/microfacets.h"
#include "shaders/passes/bounce/receiver.glsl.h"

namespace ir::passes::bounce {
namespace {

using Materials = Transport::Materials;

/// The pixels of a picture on their way into tiles and out.
class HostReconstruction {
  public:
    HostReconstruction(const graph::PassContext& context, const Filter& filter, const FilterRules& rules,
                       const SampleGroup& group, const Reconstruction& images)
        : rules_(rules),
          group_(group),
          width_(context.inputs().view.width),
          height_(context.inputs().view.height),
          receivers_(context, filter.receivers),
          directions_(graph::layers<const glm::vec4>(context, filter.directions.directions)) {
        if (rules.has_kernels) kernels_ = context.pixels<const float>(images.kernels);
        if (!group.begins || !group.ends) sums_ = context.pixels<glm::vec4>(images.sums);
        if (group.ends && rules.light) light_result_ = context.pixels<glm::vec4>(images.result);
        if (group.ends && !rules.light) result_ = context.pixels<float>(images.result);
        if (!rules.light) {
            open_ = graph::layers<const float>(context, filter.samples.incoming);
            return;
        }
        light_ = graph::layers<const glm::vec4>(context, filter.samples.incoming);
    }

    static int tiles_across(int width) { return (width + FilterTile::width - 1) / FilterTile::width; }
    static int tiles_down(int height) { return (height + FilterTile::height - 1) / FilterTile::height; }

    void run(std::int64_t number, FilterTile& tile) const {
        const auto across = tiles_across(width_);
        const int left = static_cast<int>(number % across) * FilterTile::width,
                  top = static_cast<int>(number / across) * FilterTile::height;
        for (int y = -tile.radius; y < FilterTile::height + tile.radius; ++y)
            for (int x = -tile.radius; x < FilterTile::width + tile.radius; ++x) {
                const bool is_inside =
                    left + x >= 0 && left + x < width_ && top + y >= 0 && top + y < height_;
                tile.exists[tile.at(x, y)] = 0;
                if (is_inside) fill(tile, tile.at(x, y), pixel(left + x, top + y));
            }
        const auto each_pixel = [&](const auto& to) {
            for (int y = 0; y < std::min(FilterTile::height, height_ - top); ++y)
                for (int x = 0; x < std::min(FilterTile::width, width_ - left); ++x)
                    to(static_cast<std::size_t>(y * FilterTile::width + x), tile.exists[tile.at(x, y)] > 0,
                       pixel(left + x, top + y));
        };
        for (auto& channel : tile.sums) channel.fill(0);
        if (!group_.begins)
            each_pixel([&](std::size_t at, bool, std::size_t i) {
                for (std::size_t c = 0; c < 4; ++c) tile.sums[c][at] = sums_[i][static_cast<int>(c)];
            });
        reconstruct(rules_, tile);
        each_pixel([&](std::size_t at, bool exists, std::size_t i) { take(tile, at, exists, i); });
    }

  private:
    std::size_t pixel(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }

    void fill(FilterTile& tile, std::size_t at, std::size_t i) const {
        const auto receiver = receivers_.at(i);
        if (!receiver || (rules_.light && !fill_scatterer(tile, at, i, *receiver))) return;
        tile.exists[at] = 1;
        set(tile.position, at, receiver->position);
        set(tile.blur_normal, at, receiver->stored_normal);
        set(tile.geometric_normal, at, receiver->geometric_normal);
        set(tile.normal, at, receiver->normal);
        if (rules_.has_kernels)
            tile.narrowing[at] = static_cast<float>(rules_.constants.radius) / kernels_[i];
        for (std::size_t s = 0; s < tile.samples.size(); ++s) {
            auto& sample = tile.samples[s];
            const auto layer = static_cast<std::size_t>(group_.first_layer) + s;
            const auto direction = directions_[layer][i];
            set(sample.direction, at, direction);
            sample.density[at] = direction.w;
            if (rules_.light)
                set(sample.incoming, at, light_[layer][i]);
            else
                sample.incoming[0][at] = open_[layer][i];
        }
    }

    /// make_scatterer and seen_from of lib/scattering.glsl. False of unlit surfaces.
    bool fill_scatterer(FilterTile& tile, std::size_t at, std::size_t i, const HostReceiver& receiver) const {
        const auto s = receivers_.scatterer_at(i, receiver);
        if (!s) return false;
        tile.metallic[at] = s->metallic;
        tile.roughness[at] = s->roughness;
        tile.alpha[at] = s->roughness * s->roughness;
        tile.n_dot_v[at] = std::max(s->n_dot_v, min_view_cosine);
        set(tile.viewer, at, s->viewer);
        tile.specular[at] = s->lobes.specular;
        set(tile.diffuse, at, s->lobes.diffuse);
        set(tile.f0, at, s->lobes.f0);
        if (!rules_.has_balance()) return true;
        const auto raised = s->n_dot_v < min_view_cosine
                                ? glm::normalize(s->viewer + (min_view_cosine - s->n_dot_v) * receiver.normal)
                                : s->viewer;
        set(tile.raised, at, raised);
        tile.raised_cosine[at] = glm::dot(receiver.normal, raised);
        tile.specular_probability[at] = specular_probability(
            receivers_.lobes_of(glm::max(s->colour, glm::vec3(min_colour)), s->metallic, s->ior),
            tile.raised_cosine[at]);
        return true;
    }

    float specular_probability(const HostLobes& lobes, float cosine) const {
        const auto fresnel = schlick_fresnel(lobes.f0, cosine);
        const auto below =
            rules_.materials == Materials::gltf ? (1.0f - fresnel) * lobes.diffuse : lobes.diffuse;
        const float specular = lobes.specular * luminance(fresnel);
        return specular > 0 ? specular / (specular + luminance(below)) : 0;
    }

    void take(const FilterTile& tile, std::size_t at, bool exists, std::size_t i) const {
        const auto& r = tile.sums;
        if (!group_.ends)
            sums_[i] = exists ? glm::vec4(r[0][at], r[1][at], r[2][at], r[3][at]) : glm::vec4(0);
        else if (rules_.light)
            light_result_[i] = exists ? glm::vec4(r[0][at], r[1][at], r[2][at], 0) : glm::vec4(0);
        else
            result_[i] = exists ? r[0][at] : 1;
    }

    const FilterRules& rules_;
    SampleGroup group_;
    int width_, height_;
    HostReceivers receivers_;
    std::vector<std::span<const glm::vec4>> directions_, light_;
    std::vector<std::span<const float>> open_;
    std::span<glm::vec4> sums_, light_result_;
    std::span<const float> kernels_;
    std::span<float> result_;
};

}  // namespace

void reconstruct_on_host(graph::GraphBuilder& builder, const Filter& filter, const SampleGroup& group,
                         const std::string& name, const Reconstruction& reconstruction) {
    const auto& inputs = builder.inputs();
    const auto& options = filter.receivers.options;
    FilterRules rules{.constants = filter.constants(inputs),
                      .has_kernels = filter.kernels.index >= 0,
                      .ends = group.ends,
                      .light = options.light,
                      .ratio = filter.parameters.estimator == Estimator::ratio,
                      .materials = options.materials};
    rules.constants.samples = group.samples;
    const auto tiles = std::int64_t{HostReconstruction::tiles_across(inputs.view.width)} *
                       HostReconstruction::tiles_down(inputs.view.height);
    auto pass = builder.pass(name, graph::Queue::cpu);
    HostReceivers::declare_reads(pass, filter.receivers);
    pass.has_two_bodies().reads(filter.directions.directions, filter.samples.incoming);
    if (filter.kernels.index >= 0) pass.reads(filter.kernels);
    if (!group.begins && group.ends) pass.reads(reconstruction.sums);
    pass.writes(group.ends ? reconstruction.result : reconstruction.sums);
    pass.execute_sliced(
        tiles,
        [=](graph::PassContext& context, graph::Slice slice) {
            const HostReconstruction work(context, filter, rules, group, reconstruction);
            tbb::task_arena arena(arena_size(context.inputs().threads));
            arena.execute([&] {
                tbb::enumerable_thread_specific<FilterTile> scratch(rules);
                tbb::parallel_for(slice.begin, slice.end,
                                  [&](std::int64_t tile) { work.run(tile, scratch.local()); });
            });
        },
        std::max<std::int64_t>(1, tiles / 8));
}

}  // namespace ir::passes::bounce
