#include "renderers/methods/reference/tiles.h"

#include "renderers/core/threads.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace ir::methods::reference {

void start_sums(const graph::PassContext& context, graph::ImageRef sums, int layers) {
    const bool continues = Progress::continues(context);
    for (int layer = 0; layer < layers; ++layer) {
        const auto now = context.pixels<glm::vec4>(sums, layer);
        if (!continues) {
            std::fill(now.begin(), now.end(), glm::vec4(0));
            continue;
        }
        const auto before = context.previous_contents<glm::vec4>(sums, layer);
        std::copy(before.begin(), before.end(), now.begin());
    }
}

std::int64_t declared_items(const Tiles& tiles, std::uint64_t per_frame) {
    return tiles.count() * tiles.blocks({0, per_frame});
}

void run_tiles(const graph::PassContext& context, const Tiles& tiles, SampleRange samples, graph::Slice slice,
               std::int64_t declared, const std::function<void(std::int64_t, SampleRange)>& trace) {
    const auto count = tiles.count(), work = count * tiles.blocks(samples);
    const auto place = [&](std::int64_t item) {
        return static_cast<std::int64_t>(static_cast<double>(item) / static_cast<double>(declared) *
                                         static_cast<double>(work));
    };
    const int threads = context.inputs().threads;
    tbb::task_arena arena(arena_size(threads));
    const auto last = slice.end == declared ? work : place(slice.end);
    for (auto item = place(slice.begin); item < last;) {
        const auto range = tiles.block(samples, item / count);
        const auto end = std::min(last, (item / count + 1) * count);
        arena.execute([&] {
            tbb::parallel_for(item, end, [&](std::int64_t i) {
                if (tiles.has_tile(i % count) && !context.cancel().is_cancelled()) trace(i % count, range);
            });
        });
        context.cancel().check();
        item = end;
    }
}

}  // namespace ir::methods::reference
