#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "renderers/passes/vectors/lanes.h"

namespace ir::passes {

/// A bijection of 64-bit numbers whose results look independent [Steele14, the finaliser of SplitMix].
constexpr std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// Seed of everything random in one pixel.
constexpr std::uint64_t pixel_key(std::uint64_t seed, std::uint32_t x, std::uint32_t y) {
    return mixed(mixed(seed) ^ (std::uint64_t{y} << 32 | x));
}

/// The first two dimensions of Sobol's sequence, Owen-scrambled with a hash [Laine11, Burley20]. The scramble
/// starts by adding a seed to the reversed bits, everything after that is a bijection: over the seeds each
/// point is uniform in the unit square, so that averages stay unbiased. A point depends on key and index
/// alone, hence on no order of work.
class PointSequence {
  public:
    PointSequence() = default;
    explicit PointSequence(std::uint64_t key);
    /// In [0, 1)².
    glm::vec2 point(std::uint32_t index) const;

  private:
    std::uint32_t seed_x_ = 0, seed_y_ = 0;
};

/// All random numbers of one path, by pairs: dimension d gives a point of a sequence of its own, in which
/// the path's place is shuffled, so that dimensions are not correlated and each is well distributed over the
/// paths of a pixel and randomisation [Burley20 §5]. Depends on key, index and dimension alone.
class PathSampler {
  public:
    PathSampler() = default;
    /// Point `index` of the sequences of `key`.
    PathSampler(std::uint64_t key, std::uint32_t index) : key_(key), index_(index) {}
    /// In [0, 1)².
    glm::vec2 pair(std::uint32_t dimension) const;
    /// The same of up to 16 samplers, cheaper where neighbours share a key.
    static void pairs(std::span<const PathSampler> samplers, std::uint32_t dimension, Lanes2& pairs);

  private:
    std::uint64_t key_ = 0;
    std::uint32_t index_ = 0;
};

}  // namespace ir::passes
