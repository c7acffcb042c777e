#include "renderers/passes/ldm/host/meshlets.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <glm/glm.hpp>
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

/// Numbers of triangles first … end - 1 in the order of the curve.
std::vector<std::uint32_t> along_curve(const scene::World& world, std::uint32_t first, std::uint32_t end) {
    std::vector<std::uint64_t> keys(end - first);
    tbb::parallel_for(first, end, [&](std::uint32_t triangle) {
        const auto* corner = &world.indices[3 * std::size_t{triangle}];
        const auto middle =
            (world.positions[corner[0]] + world.positions[corner[1]] + world.positions[corner[2]]) / 3.0f;
        keys[triangle - first] = std::uint64_t{morton_code(middle, world.bounds)} << 32 | triangle;
    });
    tbb::parallel_sort(keys);
    std::vector<std::uint32_t> order(keys.size());
    std::transform(keys.begin(), keys.end(), order.begin(),
                   [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
    return order;
}

/// Cuts triangles first … end - 1, in the order of the curve, into meshlets.
void cut_into(Meshlets& result, const scene::World& world, std::uint32_t first, std::uint32_t end,
              bool masked) {
    const auto order = along_curve(world, first, end);
    constexpr std::size_t size = Meshlet::max_triangles;
    const auto count = (order.size() + size - 1) / size, before = result.meshlets.size();
    result.meshlets.resize(before + count, Meshlet{});
    if (masked) result.masked_triangles.resize(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        auto& meshlet = result.meshlets[before + i];
        meshlet.triangles = static_cast<int>(std::min(size, order.size() - i * size));
        for (int t = 0; t < meshlet.triangles; ++t) {
            const auto triangle = order[i * size + static_cast<std::size_t>(t)];
            for (int corner = 0; corner < 3; ++corner) {
                const auto& position = world.positions[world.indices[3 * std::size_t{triangle} +
                                                                     static_cast<std::size_t>(corner)]];
                meshlet.x[corner][t] = position.x;
                meshlet.y[corner][t] = position.y;
                meshlet.z[corner][t] = position.z;
            }
            if (masked)
                result.masked_triangles[i][static_cast<std::size_t>(t)] = triangle - world.opaque_triangles;
        }
    });
}

float area_of(const Meshlet& meshlet) {
    const auto corner = [&](int k, int triangle) {
        return glm::vec3(meshlet.x[k][triangle], meshlet.y[k][triangle], meshlet.z[k][triangle]);
    };
    float sum = 0;
    for (int t = 0; t < meshlet.triangles; ++t)
        sum += glm::length(glm::cross(corner(1, t) - corner(0, t), corner(2, t) - corner(0, t)));
    return sum;
}

/// Part of the area that each stage and those before it have.
constexpr double stage_parts[Meshlets::stages] = {0.2, 0.45, 0.75, 2};

void order_by_stages(Meshlets& result) {
    std::vector<std::pair<float, std::size_t>> areas(result.meshlets.size());
    tbb::parallel_for(std::size_t{0}, areas.size(), [&](std::size_t i) {
        areas[i] = {-area_of(result.meshlets[i]), i};
    });
    double all = 0, sum = 0;
    for (const auto& [area, i] : areas) all -= double{area};
    std::sort(areas.begin(), areas.end());
    std::vector<int> stages(areas.size());
    int stage = 0;
    for (const auto& [area, i] : areas) {
        while (sum > stage_parts[stage] * all) ++stage;
        sum -= double{area};
        stages[i] = stage;
    }
    std::vector<Meshlet> ordered;
    ordered.reserve(result.meshlets.size());
    for (stage = 0; stage < Meshlets::stages; ++stage) {
        for (std::size_t i = 0; i < areas.size(); ++i)
            if (stages[i] == stage) ordered.push_back(result.meshlets[i]);
        result.stage_ends[stage] = ordered.size();
    }
    result.meshlets = std::move(ordered);
}

void find_boxes(Meshlets& result) {
    const auto count = result.meshlets.size();
    for (int axis = 0; axis < 3; ++axis) {
        result.centre[axis].assign(count + box_padding, 0);
        result.half[axis].assign(count + box_padding, 0);
    }
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        const auto& meshlet = result.meshlets[i];
        const float(*axes[3])[Meshlet::max_triangles] = {meshlet.x, meshlet.y, meshlet.z};
        for (int axis = 0; axis < 3; ++axis) {
            float least = axes[axis][0][0], most = least;
            for (int corner = 0; corner < 3; ++corner)
                for (int t = 0; t < meshlet.triangles; ++t) {
                    least = std::min(least, axes[axis][corner][t]);
                    most = std::max(most, axes[axis][corner][t]);
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
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute([&] {
        cut_into(result, world, 0, world.opaque_triangles, false);
        order_by_stages(result);
        cut_into(result, world, world.opaque_triangles, static_cast<std::uint32_t>(world.triangles()), true);
        find_boxes(result);
    });
    return result;
}

}  // namespace ir::passes::ldm
