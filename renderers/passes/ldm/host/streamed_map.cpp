#include "renderers/passes/ldm/host/streamed_map.h"

#include <bit>
#include <cmath>

namespace ir::passes::ldm {

std::array<StreamedMap::Level, StreamedMap::level_count> StreamedMap::levels_of(int resolution, int rows) {
    std::array<Level, level_count> levels{{{0, resolution, rows}}};
    const auto blocks = [](int cells) { return (cells + block_side - 1) / block_side; };
    for (std::size_t i = 1; i < levels.size(); ++i)
        levels[i] = {levels[i - 1].end(), blocks(levels[i - 1].columns), blocks(levels[i - 1].rows)};
    return levels;
}

float sum_scale(int maps) {
    // One part in 2^23 is what a float resolves near 1; sums have 32 bits, of which one is spare.
    const auto bits = std::bit_width(static_cast<unsigned>(std::max(1, maps - 1)));
    return std::ldexp(1.0f, std::min(23, 31 - static_cast<int>(bits)));
}

void SelfHitCounts::resize(std::size_t pixels) {
    for (auto* counts : {&own, &queried, &rejected}) counts->assign(pixels, 0);
}

void SelfHitCounts::add(const SelfHitCounts& other) {
    for (const auto counts : {&SelfHitCounts::own, &SelfHitCounts::queried, &SelfHitCounts::rejected})
        for (std::size_t i = 0; i < (this->*counts).size(); ++i) (this->*counts)[i] += (other.*counts)[i];
}

}  // namespace ir::passes::ldm
