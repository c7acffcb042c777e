#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>

#include "renderers/core/threads.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/ldm-indirect/looks.h"
#include "renderers/methods/ldm-indirect/splatting/host/add_kernels.h"
#include "renderers/methods/ldm-indirect/splatting/stored.h"
#include "renderers/passes/photons/photon_list.h"

namespace ir::methods::ldm_indirect {
namespace {

/// Adds photons to the picture, round by round: what it holds does not grow with their number. Pixels get
/// theirs in order, whatever the number of threads.
class HostSplat {
  public:
    explicit HostSplat(int threads) : arena_(arena_size(threads)) {}

    void begin(const graph::PassContext& p, const SplatTask& task, const passes::GBuffer& gbuffer) {
        const auto shape = p.shape(gbuffer.position);
        arena_.execute([&] {
            passes::ldm::fill_pixel_tiles(
                tiles_, {.width = shape.width,
                         .height = shape.height,
                         .position = p.pixels<const glm::vec4>(gbuffer.position),
                         .normal = p.pixels<const std::uint64_t>(gbuffer.normal),
                         .geometric_normal = p.pixels<const glm::vec4>(gbuffer.geometric_normal)});
        });
        groups_ = group_tiles(tiles_);
        for (auto& channel : sums_.channel) channel.assign(tiles_.count() * PixelTiles::pixels, 0.0f);
        maker_.emplace(footprints(p.inputs(), task.photons),
                       arrivals_of(task.photons.parameters, *p.inputs().world));
        mended_ = {};
        looks_ = {};
        if (!task.photons.looks) return;
        looks_.maps = static_cast<std::size_t>(task.photons.parameters.maps.directions);
        looks_.units_per_metre = units_per_metre(*p.inputs().world);
        find_looks(p, task);
        arena_.execute([&] { find_ranges(tiles_, groups_, looks_); });
    }

    /// Contents may move from slice to slice.
    void find_looks(const graph::PassContext& p, const SplatTask& task) {
        if (task.photons.looks) looks_.looks = p.elements<const std::uint8_t>(*task.photons.looks);
    }

    void add(std::span<const Photon> photons) {
        arena_.execute([&] {
            make_kernels(photons);
            tbb::parallel_for(std::size_t{0}, groups_.count(), [&](std::size_t group) {
                add_to_group(tiles_, groups_, looks_, round_, group, sums_);
            });
        });
    }

    void write(std::span<glm::vec4> irradiance, std::span<glm::vec4> direction) {
        arena_.execute([&] {
            tbb::parallel_for(0, tiles_.height, [&](int y) {
                for (int x = 0; x < tiles_.width; ++x) {
                    const auto from = tiles_.place(x, y);
                    const auto to = static_cast<std::size_t>(y) * static_cast<std::size_t>(tiles_.width) +
                                    static_cast<std::size_t>(x);
                    for (int i = 0; i < 4; ++i) irradiance[to][i] = sums_.channel[i][from];
                    for (int i = 0; i < 3; ++i) direction[to][i] = sums_.channel[4 + i][from];
                }
            });
        });
    }

    const MendedFootprints& mended() const { return mended_; }

  private:
    void make_kernels(std::span<const Photon> photons) {
        const auto words = (photons.size() + KernelRound::word - 1) / KernelRound::word;
        round_.made.resize(photons.size());
        round_.reaching.resize(words * groups_.count());
        std::mutex mutex;
        tbb::parallel_for(std::size_t{0}, words, [&](std::size_t word) {
            MendedFootprints mended;
            const auto first = word * KernelRound::word;
            for (auto i = first; i < std::min(first + KernelRound::word, photons.size()); ++i)
                round_.made[i] = maker_->make(photons[i], mended);
            find_groups(groups_, looks_, round_, word);
            const std::scoped_lock lock(mutex);
            mended_ += mended;
        });
    }

    tbb::task_arena arena_;
    PixelTiles tiles_;
    TileGroups groups_;
    TileSums sums_;
    TileLooks looks_;
    std::optional<KernelMaker> maker_;
    KernelRound round_;
    MendedFootprints mended_;
};

}  // namespace

void splat_on_host(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const SplatTask& task) {
    const auto counters = declare_mended(builder);
    const auto splat = std::make_shared<HostSplat>(builder.inputs().threads);
    auto pass = builder.pass("splat photons", graph::Queue::cpu);
    if (task.photons.looks) pass.reads(*task.photons.looks);
    pass.has_two_bodies()
        .reads(task.photons.records, task.photons.stored, gbuffer.position, gbuffer.normal,
               gbuffer.geometric_normal)
        .writes(task.irradiance, task.direction)
        .counts(counters.axes_short)
        .counts(counters.axes_long)
        .counts(counters.degenerate)
        .counts(counters.broken)
        .execute_sliced(passes::photon_parts, [=](graph::PassContext& p, graph::Slice slice) {
            if (slice.first)
                splat->begin(p, task, gbuffer);
            else
                splat->find_looks(p, task);
            passes::add_stored<Photon>(p, task.photons, slice, KernelRound::kernels,
                                       [&](auto photons) { splat->add(photons); });
            if (!slice.last) return;
            splat->write(p.pixels<glm::vec4>(task.irradiance), p.pixels<glm::vec4>(task.direction));
            p.add(counters.axes_short, splat->mended().axes_short);
            p.add(counters.axes_long, splat->mended().axes_long);
            p.add(counters.degenerate, splat->mended().degenerate);
            p.add(counters.broken, splat->mended().broken);
        });
}

}  // namespace ir::methods::ldm_indirect
