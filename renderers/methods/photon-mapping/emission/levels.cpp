#include "renderers/methods/photon-mapping/emission/levels.h"

#include <bit>
#include <cmath>

#include "renderers/methods/photon-mapping/emission/histogram.h"

namespace ir::methods::photon_mapping {
namespace {

std::vector<std::vector<double>> empty_levels(int resolution) {
    std::vector<std::vector<double>> levels(
        static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(resolution))));
    for (std::size_t i = 0; i < levels.size(); ++i) levels[i].resize(std::size_t{1} << 2 * i);
    return levels;
}

double squared(double x) {
    return x * x;
}

/// Of points that are even within the cells of a level, and follow the map from cell to cell.
float efficiency_of(const LevelSums& followed, const LevelSums& wanted, int level) {
    const int finest = wanted.levels(), shift = finest - level, side = 1 << finest;
    const double sum = wanted.at(0, 0, 0), all = followed.at(0, 0, 0);
    const double texels = std::ldexp(1.0, 2 * shift);
    double squares = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double q = wanted.at(finest, x, y);
            if (q > 0) squares += q * q * all * texels / followed.at(level, x >> shift, y >> shift);
        }
    return squares > 0 ? static_cast<float>(squared(sum) / squares) : 0;
}

}  // namespace

LevelSums::LevelSums(std::span<const float> map, int resolution) : sums_(empty_levels(resolution)) {
    sums_.back().assign(map.begin(), map.end());
    add_levels();
}

LevelSums::LevelSums(std::span<const std::uint32_t> texels, int resolution)
    : sums_(empty_levels(resolution)) {
    for (const auto texel : texels) ++sums_.back().at(texel);
    add_levels();
}

void LevelSums::add_levels() {
    for (int level = levels() - 1; level >= 0; --level) {
        const int side = 1 << level;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                sums_[static_cast<std::size_t>(level)][static_cast<std::size_t>(side * y + x)] =
                    at(level + 1, 2 * x, 2 * y) + at(level + 1, 2 * x + 1, 2 * y) +
                    at(level + 1, 2 * x, 2 * y + 1) + at(level + 1, 2 * x + 1, 2 * y + 1);
    }
}

double LevelSums::at(int level, int x, int y) const {
    return sums_[static_cast<std::size_t>(level)]
                [(static_cast<std::size_t>(y) << level) + static_cast<std::size_t>(x)];
}

std::vector<LevelFit> fits_of(const LevelSums& followed, const LevelSums& wanted, const LevelSums& points) {
    std::vector<LevelFit> fits;
    for (int level = 0; level <= followed.levels(); ++level) {
        const auto fit = chi_square(followed.level(level), points.level(level));
        fits.push_back({static_cast<std::uint32_t>(level), 1u << level, fit.sum, fit.degrees,
                        efficiency_of(followed, wanted, level)});
    }
    return fits;
}

std::vector<CellOnTheWay> way_to(glm::ivec2 texel, const LevelSums& map, const LevelSums& points) {
    const double sum = map.at(0, 0, 0), all = points.at(0, 0, 0);
    std::vector<CellOnTheWay> way;
    for (int level = 0; level <= map.levels(); ++level) {
        const int shift = map.levels() - level, x = texel.x >> shift, y = texel.y >> shift;
        CellOnTheWay cell{};
        cell.level = static_cast<std::uint32_t>(level);
        cell.x = static_cast<std::uint32_t>(x), cell.y = static_cast<std::uint32_t>(y);
        const double texels = std::ldexp(1.0, 2 * shift);
        cell.mean = static_cast<float>(map.at(level, x, y) / texels);
        if (shift > 0) {
            const double a = map.at(level + 1, 2 * x, 2 * y), b = map.at(level + 1, 2 * x + 1, 2 * y);
            const double c = map.at(level + 1, 2 * x, 2 * y + 1), d = map.at(level + 1, 2 * x + 1, 2 * y + 1);
            cell.horizontal = static_cast<float>((a - b + c - d) / texels);
            cell.vertical = static_cast<float>((a + b - c - d) / texels);
            cell.diagonal = static_cast<float>((a - b - c + d) / texels);
        }
        cell.expected = sum > 0 ? static_cast<float>(all * map.at(level, x, y) / sum) : 0;
        cell.found = static_cast<float>(points.at(level, x, y));
        way.push_back(cell);
    }
    return way;
}

std::optional<SeenAt> seen_at(const passes::ShadowViewData& view, glm::vec3 position_ws, int resolution) {
    const auto offset = position_ws - view.origin_ws;
    const float depth = glm::dot(offset, view.forward_ws);
    const float scale = view.perspective != 0 ? depth : 1;
    if (!(depth > 0) || !(scale > 0)) return {};
    const glm::vec2 ndc(glm::dot(offset, view.right_ws) / (scale * glm::dot(view.right_ws, view.right_ws)),
                        glm::dot(offset, view.up_ws) / (scale * glm::dot(view.up_ws, view.up_ws)));
    const auto place = glm::floor((ndc * glm::vec2(1, -1) + 1.0f) * 0.5f * static_cast<float>(resolution));
    if (place.x < 0 || place.y < 0 || place.x >= static_cast<float>(resolution) ||
        place.y >= static_cast<float>(resolution))
        return {};
    return SeenAt{glm::ivec2(place), depth / view.far};
}

}  // namespace ir::methods::photon_mapping
