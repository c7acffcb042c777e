#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "renderers/core/fields.h"
#include "shaders/passes/shadow/shadow.glsl.h"

namespace ir::methods::photon_mapping {

/// How well points follow a map down to one level of its pyramid.
struct LevelFit {
    std::uint32_t level, cells;  ///< 2^level cells a side
    float chi_square;            ///< of the points against what the map expects of each cell
    std::int32_t degrees;
    float efficiency;  ///< of points that follow the map down to here and are even within the cells
    IR_FIELDS(level, cells, chi_square, degrees, efficiency)
};

/// A cell of a level, on the way to a texel.
struct CellOnTheWay {
    std::uint32_t source, level, x, y;
    float mean, horizontal, vertical, diagonal;  ///< coefficients of its quad; of a texel only the mean
    float expected, found;                       ///< points
    std::uint32_t lit;                           ///< 1: the light sees the surface
    IR_FIELDS(source, level, x, y, mean, horizontal, vertical, diagonal, expected, found, lit)
};

/// A map with all of its levels: sums over cells, from one cell to the texels.
class LevelSums {
  public:
    /// Square, row 0 first, a power of two a side.
    LevelSums(std::span<const float> map, int resolution);
    /// How many points came to each cell. `texels`: x + resolution · y of each point.
    LevelSums(std::span<const std::uint32_t> texels, int resolution);
    int levels() const { return static_cast<int>(sums_.size()) - 1; }  ///< of texels
    std::span<const double> level(int number) const { return sums_.at(static_cast<std::size_t>(number)); }
    double at(int level, int x, int y) const;

  private:
    void add_levels();
    std::vector<std::vector<double>> sums_;
};

/// From the whole map to its texels. `followed`: what points follow; `wanted`: what they should follow, for
/// the efficiency (Σ q)² / Σ q²/p of a map q by probabilities p, 1 where p is in proportion to q.
std::vector<LevelFit> fits_of(const LevelSums& followed, const LevelSums& wanted, const LevelSums& points);

/// The cells from the whole map down to a texel.
std::vector<CellOnTheWay> way_to(glm::ivec2 texel, const LevelSums& map, const LevelSums& points);

/// Where a layer sees a point of the scene: texel, and depth as the map holds it. None outside of the layer.
struct SeenAt {
    glm::ivec2 texel;
    float depth;
};
std::optional<SeenAt> seen_at(const passes::ShadowViewData& view, glm::vec3 position_ws, int resolution);

}  // namespace ir::methods::photon_mapping
