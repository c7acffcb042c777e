#include "renderers/passes/sampling/point_sequence.h"

#include "renderers/passes/sampling/pcg.h"
#include "renderers/passes/sampling/scrambled_points.h"

namespace ir::passes {
namespace {

std::uint32_t reversed(std::uint32_t x) {
    x = __builtin_bswap32(x);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// Nested permutation of reversed bits: each bit is flipped depending on those below it [Laine11 §3.3].
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return x;
}

/// Second dimension of Sobol's sequence with its bits reversed. The generator matrix is Pascal's triangle
/// modulo 2, the fifth Kronecker power of ((1, 1), (0, 1)): in each half the lower part takes the upper one.
std::uint32_t reversed_sobol_second(std::uint32_t index) {
    index ^= index >> 16;
    index ^= (index >> 8) & 0x00ff00ffu;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 2) & 0x33333333u;
    return index ^ ((index >> 1) & 0x55555555u);
}

/// The first dimension is the reversed index, which the scramble wants reversed again.
glm::vec2 scrambled_point(std::uint32_t index, std::uint32_t seed_x, std::uint32_t seed_y) {
    return {unit_float(reversed(scrambled(index, seed_x))),
            unit_float(reversed(scrambled(reversed_sobol_second(index), seed_y)))};
}

}  // namespace

PointSequence::PointSequence(std::uint64_t key) {
    const auto seeds = mixed(key);
    seed_x_ = static_cast<std::uint32_t>(seeds);
    seed_y_ = static_cast<std::uint32_t>(seeds >> 32);
}

glm::vec2 PointSequence::point(std::uint32_t index) const {
    return scrambled_point(index, seed_x_, seed_y_);
}

glm::vec2 PathSampler::pair(std::uint32_t dimension) const {
    const auto seeds = mixed(key_ ^ mixed(dimension));
    const auto order = static_cast<std::uint32_t>(mixed(seeds));
    const auto shuffled = reversed(scrambled(reversed(index_), order));
    return scrambled_point(shuffled, static_cast<std::uint32_t>(seeds),
                           static_cast<std::uint32_t>(seeds >> 32));
}

void PathSampler::pairs(std::span<const PathSampler> samplers, std::uint32_t dimension, Lanes2& pairs) {
    const auto mixed_dimension = mixed(dimension);
    PointSeeds seeds;
    for (std::size_t i = 0; i < samplers.size(); ++i) {
        seeds.index[i] = samplers[i].index_;
        if (i > 0 && samplers[i].key_ == samplers[i - 1].key_) {
            seeds.order[i] = seeds.order[i - 1];
            seeds.x[i] = seeds.x[i - 1];
            seeds.y[i] = seeds.y[i - 1];
            continue;
        }
        const auto both = mixed(samplers[i].key_ ^ mixed_dimension);
        seeds.order[i] = static_cast<std::uint32_t>(mixed(both));
        seeds.x[i] = static_cast<std::uint32_t>(both);
        seeds.y[i] = static_cast<std::uint32_t>(both >> 32);
    }
    scramble_points(seeds, pairs);
}

}  // namespace ir::passes
