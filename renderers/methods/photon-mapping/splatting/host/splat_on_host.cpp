#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <glm/gtc/packing.hpp>
#include <memory>
#include <optional>

#include "renderers/core/half_float.h"
#include "renderers/core/threads.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/photon-mapping/splatting/host/add_kernels.h"
#include "renderers/methods/photon-mapping/splatting/host/receivers.h"
#include "renderers/methods/photon-mapping/splatting/stages.h"
#include "renderers/passes/photons/photon_list.h"

namespace ir::methods::photon_mapping {
namespace {

/// Rows that a thread adds to: whole ones, so that texels get their kernels in order.
constexpr int rows_at_once = 8;

/// Adds photons to the picture, round by round: what it holds does not grow with their number.
class HostSplat {
  public:
    explicit HostSplat(int threads) : arena_(arena_size(threads)) {}

    void begin(const graph::PassContext& p, const Kernels& kernels) {
        const auto& inputs = p.inputs();
        const auto& gbuffer = kernels.surfaces.gbuffer;
        const int divisor = kernels.surfaces.divisor;
        const auto size = texels_of(inputs.view, divisor);
        const auto tiles = p.shape(kernels.tiles);
        maker_.emplace(kernel_rules(inputs, kernels.parameters, kernels.photons.power_unit),
                       p.pixels<const std::uint32_t>(kernels.tiles), tiles.width,
                       kernels.parameters.edge_probes ? &planes_ : nullptr);
        receivers_.reset();
        if (kernels.parameters.reflects_each_photon()) receivers_.emplace(p, kernels);
        const bool tests_normals = kernels.parameters.facing_test && !receivers_;
        planes_.resize(size.x, size.y, tests_normals);
        const auto set = [&](std::vector<float>(&planes)[3], graph::ImageRef image) {
            const auto pixels = p.pixels<const glm::vec4>(image);
            for_rows(1, [&](int y, int) { set_row(planes, pixels, inputs.view, divisor, y); });
        };
        set(planes_.position, gbuffer.position);
        if (tests_normals) set(planes_.normal, gbuffer.geometric_normal);
    }

    void add(std::span<const Photon> photons) {
        round_.made.resize(photons.size());
        round_.boxes.resize(photons.size());
        arena_.execute([&] {
            tbb::parallel_for(tbb::blocked_range<std::size_t>(0, photons.size(), 256), [&](const auto& part) {
                for (auto i = part.begin(); i < part.end(); ++i)
                    if (const auto kernel = maker_->make(photons[i], round_.boxes[i]))
                        round_.made[i] = *kernel;
            });
        });
        for_rows(rows_at_once, [&](int first, int end) {
            if (receivers_)
                receivers_->add_to_rows(planes_, round_, first, end);
            else
                add_to_rows(planes_, round_, first, end);
        });
    }

    void write(const graph::PassContext& p, graph::ImageRef irradiance, graph::ImageRef direction,
               bool half) {
        for_rows(rows_at_once, [&](int first, int end) {
            for (int y = first; y < end; ++y)
                for (int x = 0; x < planes_.width; ++x) {
                    const auto from = planes_.place(x, y);
                    const auto to = static_cast<std::size_t>(y) * static_cast<std::size_t>(planes_.width) +
                                    static_cast<std::size_t>(x);
                    const auto sum = [&](int i) { return planes_.sums[i][from]; };
                    const glm::vec4 value(sum(0), sum(1), sum(2), sum(3));
                    const glm::vec2 rest(sum(4), sum(5));
                    if (half) {
                        p.pixels<std::uint64_t>(irradiance)[to] = pack_halves(value);
                        p.pixels<std::uint32_t>(direction)[to] = glm::packHalf2x16(rest);
                    } else {
                        p.pixels<glm::vec4>(irradiance)[to] = value;
                        p.pixels<glm::vec2>(direction)[to] = rest;
                    }
                }
        });
    }

  private:
    template <class Run>
    void for_rows(int rows, Run run) {
        const int blocks = (planes_.height + rows - 1) / rows;
        arena_.execute([&] {
            tbb::parallel_for(0, blocks, [&](int block) {
                run(block * rows, std::min((block + 1) * rows, planes_.height));
            });
        });
    }

    /// What the texels' pixels have, where they show a surface.
    void set_row(std::vector<float> (&planes)[3], std::span<const glm::vec4> pixels, const scene::View& view,
                 int divisor, int y) {
        const int row = divisor * y + pixel_of_texel(divisor);
        for (int x = 0; x < planes_.width; ++x) {
            const int column = divisor * x + pixel_of_texel(divisor);
            if (column >= view.width || row >= view.height) continue;
            const auto& pixel = pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(view.width) +
                                       static_cast<std::size_t>(column)];
            if (pixel == glm::vec4(0)) continue;
            for (int axis = 0; axis < 3; ++axis) planes[axis][planes_.place(x, y)] = pixel[axis];
        }
    }

    tbb::task_arena arena_;
    TexelPlanes planes_;
    KernelRound round_;
    std::optional<KernelMaker> maker_;
    std::optional<TexelReceivers> receivers_;  ///< where each photon is reflected by itself
};

}  // namespace

void TexelPlanes::resize(int w, int h, bool has_normals) {
    width = w, height = h, stride = w + padding;
    const auto count = static_cast<std::size_t>(stride) * static_cast<std::size_t>(h);
    for (auto& axis : position) axis.assign(count, nowhere);
    for (auto& axis : normal) axis.assign(has_normals ? count : 0, 0.0f);
    for (auto& sum : sums) sum.assign(count, 0.0f);
}

void splat_on_host(graph::GraphBuilder& builder, const Kernels& kernels, const KernelPass& pass) {
    const auto& gbuffer = kernels.surfaces.gbuffer;
    const auto splat = std::make_shared<HostSplat>(builder.inputs().threads);
    const bool half = kernels.parameters.has_half_sums();
    auto declared = builder.pass(pass.name, graph::Queue::cpu);
    if (kernels.parameters.reflects_each_photon())
        TexelReceivers::declare_reads(declared, kernels);
    else
        declared.reads(gbuffer.position, gbuffer.geometric_normal);
    declared.has_two_bodies()
        .reads(kernels.photons.records, kernels.photons.stored, kernels.tiles)
        .writes(pass.targets[0], pass.targets[1])
        .execute_sliced(passes::photon_parts, [=](graph::PassContext& p, graph::Slice slice) {
            if (slice.first) splat->begin(p, kernels);
            passes::add_stored<Photon>(p, kernels.photons, slice, KernelRound::kernels,
                                       [&](auto photons) { splat->add(photons); });
            if (slice.last) splat->write(p, pass.targets[0], pass.targets[1], half);
        });
}

}  // namespace ir::methods::photon_mapping
