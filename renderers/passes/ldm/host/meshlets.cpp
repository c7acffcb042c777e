#include "renderers/passes/ldm/host/meshlets.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
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

/// Cuts a range of triangles, in the order of the curve, into meshlets.
class Cutter {
  public:
    Cutter(const scene::World& world, bool masked) : world_(world), masked_(masked) {}

    void cut(std::span<const std::uint32_t> triangles) {
        for (const auto triangle : triangles) add(triangle);
        finish();
    }
    void append_to(Meshlets& result) {
        result.meshlets.insert(result.meshlets.end(), meshlets_.begin(), meshlets_.end());
        result.masked_triangles.insert(result.masked_triangles.end(), numbers_.begin(), numbers_.end());
    }

  private:
    /// The vertex's place in the open meshlet; -1: it has no room. Equal positions are one vertex.
    int place_of(const glm::vec3& position) {
        const auto x = position.x + 0.0f, y = position.y + 0.0f, z = position.z + 0.0f;  // no -0
        auto slot =
            (std::bit_cast<std::uint32_t>(x) * 0x9e3779b1u ^ std::bit_cast<std::uint32_t>(y) * 0x85ebca77u ^
             std::bit_cast<std::uint32_t>(z) * 0xc2b2ae3du) >>
            24;
        for (;; slot = (slot + 1) % slots_.size()) {
            const int place = slots_[slot];
            if (place < 0) break;
            if (open_.x[place] == x && open_.y[place] == y && open_.z[place] == z) return place;
        }
        if (vertices_ == Meshlet::max_vertices) return -1;
        open_.x[vertices_] = x, open_.y[vertices_] = y, open_.z[vertices_] = z;
        slots_[slot] = static_cast<std::int8_t>(vertices_);
        return vertices_++;
    }

    void add(std::uint32_t triangle) {
        if (open_.triangles == Meshlet::max_triangles) finish();
        if (put(triangle)) return;
        finish();
        put(triangle);
    }

    bool put(std::uint32_t triangle) {
        int places[3];
        for (int corner = 0; corner < 3; ++corner) {
            places[corner] = place_of(world_.positions[world_.indices[3 * std::size_t{triangle} + corner]]);
            if (places[corner] < 0) return false;
        }
        for (int corner = 0; corner < 3; ++corner)
            open_.corners[corner][open_.triangles] = static_cast<std::uint8_t>(places[corner]);
        if (masked_) open_numbers_[open_.triangles] = triangle - world_.opaque_triangles;
        ++open_.triangles;
        return true;
    }

    void finish() {
        if (open_.triangles > 0) {
            for (auto* axis : {open_.x, open_.y, open_.z})
                std::fill(axis + vertices_, axis + Meshlet::max_vertices, axis[vertices_ - 1]);
            meshlets_.push_back(open_);
            if (masked_) numbers_.push_back(open_numbers_);
        }
        open_ = {};
        open_numbers_ = {};
        vertices_ = 0;
        slots_.fill(-1);
    }

    const scene::World& world_;
    bool masked_;
    Meshlet open_ = {};
    std::array<std::uint32_t, Meshlet::max_triangles> open_numbers_ = {};
    int vertices_ = 0;
    std::array<std::int8_t, 256> slots_ = filled();
    std::vector<Meshlet> meshlets_;
    std::vector<std::array<std::uint32_t, Meshlet::max_triangles>> numbers_;

    static std::array<std::int8_t, 256> filled() {
        std::array<std::int8_t, 256> slots;
        slots.fill(-1);
        return slots;
    }
};

/// Of so many consecutive triangles meshlets are cut at once.
constexpr std::uint32_t cutter_part = 8192;

void cut_into(Meshlets& result, const scene::World& world, std::uint32_t first, std::uint32_t end,
              bool masked) {
    const auto order = along_curve(world, first, end);
    std::vector<Cutter> cutters((order.size() + cutter_part - 1) / cutter_part, Cutter(world, masked));
    tbb::parallel_for(std::size_t{0}, cutters.size(), [&](std::size_t i) {
        cutters[i].cut(std::span(order).subspan(
            i * cutter_part, std::min<std::size_t>(cutter_part, order.size() - i * cutter_part)));
    });
    for (auto& cutter : cutters) cutter.append_to(result);
}

float area_of(const Meshlet& meshlet) {
    const auto corner = [&](int k, int triangle) {
        const int place = meshlet.corners[k][triangle];
        return glm::vec3(meshlet.x[place], meshlet.y[place], meshlet.z[place]);
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
        const float* axes[3] = {meshlet.x, meshlet.y, meshlet.z};
        for (int axis = 0; axis < 3; ++axis) {
            const auto [least, most] = std::minmax_element(axes[axis], axes[axis] + Meshlet::max_vertices);
            result.centre[axis][i] = 0.5f * (*least + *most);
            result.half[axis][i] = 0.5f * (*most - *least);
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
