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
                       graph::ImageRef result)
        : rules_(rules),
          width_(context.inputs().view.width),
          height_(context.inputs().view.height),
          receivers_(context, filter.receivers),
          directions_(graph::layers<const glm::vec4>(context, filter.directions.directions)),
          light_result_(rules.light ? context.pixels<glm::vec4>(result) : std::span<glm::vec4>()),
          result_(rules.light ? std::span<float>() : context.pixels<float>(result)) {
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
        reconstruct(rules_, tile);
        for (int y = 0; y < std::min(FilterTile::height, height_ - top); ++y)
            for (int x = 0; x < std::min(FilterTile::width, width_ - left); ++x)
                take(tile, x, y, pixel(left + x, top + y));
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
        for (std::size_t s = 0; s < tile.samples.size(); ++s) {
            auto& sample = tile.samples[s];
            const auto direction = directions_[s][i];
            set(sample.direction, at, direction);
            sample.density[at] = direction.w;
            if (rules_.light)
                set(sample.incoming, at, light_[s][i]);
            else
                sample.incoming[0][at] = open_[s][i];
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

    void take(const FilterTile& tile, int x, int y, std::size_t i) const {
        const bool exists = tile.exists[tile.at(x, y)] > 0;
        const auto at = static_cast<std::size_t>(y * FilterTile::width + x);
        const auto& r = tile.result;
        if (rules_.light)
            light_result_[i] = exists ? glm::vec4(r[0][at], r[1][at], r[2][at], 0) : glm::vec4(0);
        else
            result_[i] = exists ? r[0][at] : 1;
    }

    const FilterRules& rules_;
    int width_, height_;
    HostReceivers receivers_;
    std::vector<std::span<const glm::vec4>> directions_, light_;
    std::vector<std::span<const float>> open_;
    std::span<glm::vec4> light_result_;
    std::span<float> result_;
};

}  // namespace

void reconstruct_on_host(graph::GraphBuilder& builder, const Filter& filter, graph::ImageRef result) {
    const auto& inputs = builder.inputs();
    const auto& options = filter.receivers.options;
    const FilterRules rules{.constants = filter.constants(inputs),
                            .light = options.light,
                            .ratio = filter.parameters.estimator == Estimator::ratio,
                            .materials = options.materials};
    const auto tiles = std::int64_t{HostReconstruction::tiles_across(inputs.view.width)} *
                       HostReconstruction::tiles_down(inputs.view.height);
    auto pass = builder.pass("reconstruction", graph::Queue::cpu);
    HostReceivers::declare_reads(pass, filter.receivers);
    pass.has_two_bodies().reads(filter.directions.directions, filter.samples.incoming).writes(result);
    pass.execute_sliced(
        tiles,
        [=](graph::PassContext& context, graph::Slice slice) {
            const HostReconstruction work(context, filter, rules, result);
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
