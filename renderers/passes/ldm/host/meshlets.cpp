#include "renderers/passes/ldm/host/meshlets.h"

#include "renderers/core/threads.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <glm/glm.hpp>
#include <numeric>
#include <span>

namespace ir::passes::ldm {
namespace {

constexpr std::size_t box_padding = 16;  ///< at least the lanes of a vector of floats

/// Every third bit of the result is one of the ten low bits of `value`.
std::uint32_t spread(std::uint32_t value) {
    value = (value | value << 16) & 0x030000ffu;
    value = (value | value << 8) & 0x0300f00fu;
    value = (value | value << 4) & 0x030c30c3u;
    return (value | value << 2) & 0x09249249u;
}

/// Place on the Z-order curve through the bounds. [Morton66]
std::uint32_t morton_code(const glm::vec3& position, const scene::Bounds& bounds) {
    const auto size = glm::max(bounds.max - bounds.min, glm::vec3(1e-20f));
    const auto cell = glm::uvec3(glm::clamp((position - bounds.min) / size, 0.0f, 1.0f) * 1023.0f);
    return spread(cell.x) | spread(cell.y) << 1 | spread(cell.z) << 2;
}

/// A triangle's number and its place on the curve.
struct Placed {
    std::uint32_t place, triangle;
};

/// Sorts by place, digit by digit; equal ones stay in order.
void sort_by_place(std::vector<Placed>& placed) {
    constexpr int digit_bits = 10, place_bits = 30;
    std::vector<Placed> sorted(placed.size());
    for (int shift = 0; shift < place_bits; shift += digit_bits) {
        const auto digit = [&](const Placed& p) { return p.place >> shift & ((1u << digit_bits) - 1); };
        std::vector<std::size_t> begins((std::size_t{1} << digit_bits) + 1);
        for (const auto& p : placed) ++begins[digit(p) + 1];
        std::partial_sum(begins.begin(), begins.end(), begins.begin());
        for (const auto& p : placed) sorted[begins[digit(p)]++] = p;
        placed.swap(sorted);
    }
}

struct Corners {
    glm::vec3 at[3];
};
Corners corners_of(const scene::World& world, std::uint32_t triangle) {
    const auto* corner = &world.indices[3 * std::size_t{triangle}];
    return {{world.positions[corner[0]], world.positions[corner[1]], world.positions[corner[2]]}};
}

/// Triangles first … end - 1 in the order of the curve.
std::vector<Placed> along_curve(const scene::World& world, std::uint32_t first, std::uint32_t end) {
    std::vector<Placed> placed(end - first);
    tbb::parallel_for(first, end, [&](std::uint32_t triangle) {
        const auto [a, b, c] = corners_of(world, triangle).at;
        const auto middle = (a + b + c) / 3.0f;
        placed[triangle - first] = {morton_code(middle, world.bounds), triangle};
    });
    sort_by_place(placed);
    return placed;
}

constexpr std::size_t size = Meshlet::max_triangles;

std::size_t groups_of(const std::vector<Placed>& placed) {
    return (placed.size() + size - 1) / size;
}
/// Triangles of the meshlet that is `group`-th along the curve.
std::span<const Placed> group_of(const std::vector<Placed>& placed, std::size_t group) {
    return std::span(placed).subspan(group * size, std::min(size, placed.size() - group * size));
}

void fill(Meshlet& meshlet, const scene::World& world, std::span<const Placed> triangles) {
    meshlet = {};
    meshlet.triangles = static_cast<int>(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto corners = corners_of(world, triangles[t].triangle);
        for (int k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis)
                meshlet.at(static_cast<int>(t), k, axis) = corners.at[k][axis];
    }
}

/// Part of the area that occluders have.
constexpr double occluding_part = 0.75;

/// Groups, those with most area first, and how many of them are occluders; each part along the curve.
std::vector<std::size_t> by_area(const scene::World& world, const std::vector<Placed>& placed,
                                 std::size_t& occluders) {
    std::vector<std::pair<float, std::size_t>> areas(groups_of(placed));
    tbb::parallel_for(std::size_t{0}, areas.size(), [&](std::size_t group) {
        float sum = 0;
        for (const auto& [place, triangle] : group_of(placed, group)) {
            const auto [a, b, c] = corners_of(world, triangle).at;
            sum += glm::length(glm::cross(b - a, c - a));
        }
        areas[group] = {-sum, group};
    });
    double all = 0, sum = 0;
    for (const auto& [area, group] : areas) all -= double{area};
    std::sort(areas.begin(), areas.end());
    std::vector<std::size_t> order(areas.size());
    std::transform(areas.begin(), areas.end(), order.begin(), [](const auto& area) { return area.second; });
    for (occluders = 0; occluders < areas.size() && sum <= occluding_part * all; ++occluders)
        sum -= double{areas[occluders].first};
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(occluders);
    std::sort(order.begin(), middle);
    std::sort(middle, order.end());
    return order;
}

void find_boxes(Meshlets& result) {
    const auto count = result.meshlets.size();
    for (int axis = 0; axis < 3; ++axis) {
        result.centre[axis].assign(count + box_padding, 0);
        result.half[axis].assign(count + box_padding, 0);
    }
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        auto& meshlet = result.meshlets[i];
        for (int axis = 0; axis < 3; ++axis) {
            float least = meshlet.at(0, 0, axis), most = least;
            for (int corner = 0; corner < 3; ++corner)
                for (int t = 0; t < meshlet.triangles; ++t) {
                    least = std::min(least, meshlet.at(t, corner, axis));
                    most = std::max(most, meshlet.at(t, corner, axis));
                }
            result.centre[axis][i] = 0.5f * (least + most);
            result.half[axis][i] = 0.5f * (most - least);
        }
    });
}

}  // namespace

std::uint64_t Meshlets::bytes() const {
    return meshlets.size() * (sizeof(Meshlet) + 6 * sizeof(float)) +
           masked_triangles.size() * sizeof(masked_triangles.front());
}

Meshlets make_meshlets(const scene::World& world, int threads) {
    Meshlets result;
    tbb::task_arena arena(arena_size(threads));
    arena.execute([&] {
        const auto opaque = along_curve(world, 0, world.opaque_triangles),
                   masked = along_curve(world, world.opaque_triangles,
                                        static_cast<std::uint32_t>(world.triangles()));
        const auto order = by_area(world, opaque, result.occluders);
        result.opaque = order.size();
        result.meshlets.resize(order.size() + groups_of(masked));
        result.masked_triangles.resize(groups_of(masked));
        tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t i) {
            fill(result.meshlets[i], world, group_of(opaque, order[i]));
        });
        tbb::parallel_for(std::size_t{0}, groups_of(masked), [&](std::size_t i) {
            const auto triangles = group_of(masked, i);
            fill(result.meshlets[order.size() + i], world, triangles);
            for (std::size_t t = 0; t < triangles.size(); ++t)
                result.masked_triangles[i][t] = triangles[t].triangle - world.opaque_triangles;
        });
        find_boxes(result);
    });
    return result;
}

}  // namespace ir::passes::ldm
