#include "renderers/passes/raytracing/layered_depth_cube.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <sstream>

#include "renderers/core/constants.h"
#include "renderers/core/parallel_for.h"
#include "renderers/graph/declared.h"
#include "renderers/graph/pass_context.h"

namespace ir::passes {
namespace {

/// Hits nearer than so many texels must lie on the triangle itself: else a ray would meet the planes of the
/// surface that it leaves.
constexpr float near_texels = 2;
/// Where all maps are marched through, the depth at a texel's centre is so far from those in the rest of it
/// at most, in texels: slopes along both sides are at most 1 there.
constexpr float depth_reach = 1;
/// Of a texel: vertices at the scene's bounds lie on no centre then.
constexpr float margin = 0.7f;
/// Parts of a map's depth, as bits that tell where a tile of texels is empty.
constexpr float slabs = 64;

std::size_t longest_axis(const glm::vec3& v) {
    const auto size = glm::abs(v);
    return size.x >= size.y ? (size.x >= size.z ? 0 : 2) : size.y >= size.z ? 1 : 2;
}

}  // namespace

struct LayeredDepthCube::Ray {
    glm::vec3 origin, direction;
};

LayeredDepthCube::LayeredDepthCube(const scene::Scene& scene, const scene::World& world,
                                   const CubeOptions& options, int threads)
    : positions_(world.positions),
      indices_(world.indices),
      opaque_triangles_(world.opaque_triangles),
      masks_(scene, world),
      bounds_(world.bounds),
      options_(options) {
    const auto size = bounds_.empty() ? glm::vec3(1) : bounds_.max - bounds_.min;
    texel_ = std::max({size.x, size.y, size.z, 1e-6f}) / static_cast<float>(options.resolution);
    for (int axis = 0; axis < 3; ++axis) {
        auto& map = maps_[static_cast<std::size_t>(axis)];
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        map.axis = axis;
        map.columns = static_cast<int>(size[u] / texel_ + 2 * margin) + 1;
        map.rows = static_cast<int>(size[v] / texel_ + 2 * margin) + 1;
        map.origin = glm::vec2(bounds_.min[u], bounds_.min[v]) - margin * texel_;
        build(map, threads);
    }
}

std::uint64_t LayeredDepthCube::nodes() const {
    std::uint64_t sum = 0;
    for (const auto& map : maps_) sum += map.nodes.size();
    return sum;
}

std::uint64_t LayeredDepthCube::bytes() const {
    std::uint64_t bytes = 0;
    for (const auto& map : maps_)
        bytes += map.begins.size() * sizeof(std::uint32_t) + map.tiles.size() * sizeof(std::uint64_t);
    return bytes + nodes() * sizeof(Node) + positions_.size() * sizeof(glm::vec3) +
           indices_.size() * sizeof(std::uint32_t) + masks_.bytes();
}

bool LayeredDepthCube::stands_in(std::uint32_t triangle, std::size_t axis) const {
    if (options_.maps == CubeMaps::closest) return true;
    const auto a = corner(triangle, 0);
    return longest_axis(glm::cross(corner(triangle, 1) - a, corner(triangle, 2) - a)) == axis;
}

bool LayeredDepthCube::is_there(std::uint32_t triangle, float u, float v) const {
    return triangle < opaque_triangles_ || masks_.is_covered(triangle - opaque_triangles_, u, v);
}

/// Calls put(texel, depth) for the texels whose centres the triangle covers.
template <class Put>
void LayeredDepthCube::rasterise(const Map& map, std::uint32_t triangle, const Put& put) const {
    if (!stands_in(triangle, static_cast<std::size_t>(map.axis))) return;
    const int axis_u = (map.axis + 1) % 3, axis_v = (map.axis + 2) % 3;
    glm::dvec2 at[3];  // in texels; centres are whole numbers
    for (int k = 0; k < 3; ++k) {
        const auto& p = corner(triangle, k);
        at[k] = (glm::dvec2(p[axis_u], p[axis_v]) - glm::dvec2(map.origin)) / double{texel_} - 0.5;
    }
    const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
    const double area = cross(at[1] - at[0], at[2] - at[0]);
    if (!(std::abs(area) > 1e-12)) return;
    const auto low = glm::min(glm::min(at[0], at[1]), at[2]), high = glm::max(glm::max(at[0], at[1]), at[2]);
    const int first_row = std::max(0, static_cast<int>(std::ceil(low.y))),
              last_row = std::min(map.rows - 1, static_cast<int>(std::floor(high.y))),
              first_column = std::max(0, static_cast<int>(std::ceil(low.x))),
              last_column = std::min(map.columns - 1, static_cast<int>(std::floor(high.x)));
    for (int row = first_row; row <= last_row; ++row)
        for (int column = first_column; column <= last_column; ++column) {
            const auto from_first = glm::dvec2(column, row) - at[0];
            const double u = cross(from_first, at[2] - at[0]) / area,
                         v = cross(at[1] - at[0], from_first) / area;
            if (u < 0 || v < 0 || u + v > 1) continue;
            if (!is_there(triangle, static_cast<float>(u), static_cast<float>(v))) continue;
            const double depth = (1 - u - v) * double{corner(triangle, 0)[map.axis]} +
                                 u * double{corner(triangle, 1)[map.axis]} +
                                 v * double{corner(triangle, 2)[map.axis]};
            put(map.texel(column, row), static_cast<float>(depth));
        }
}

void LayeredDepthCube::build(Map& map, int threads) const {
    const auto texels = static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows);
    const auto triangles = static_cast<std::int64_t>(indices_.size() / 3);
    const auto over_triangles = [&](auto&& put) {
        parallel_for(threads, 0, triangles, [&](std::int64_t i) {
            const auto triangle = static_cast<std::uint32_t>(i);
            rasterise(map, triangle, [&](std::size_t texel, float depth) {
                put(texel, Node{depth, triangle});
            });
        });
    };
    std::vector<std::atomic<std::uint32_t>> places(texels);
    over_triangles(
        [&](std::size_t texel, const Node&) { places[texel].fetch_add(1, std::memory_order_relaxed); });
    map.begins.assign(texels + 1, 0);
    for (std::size_t i = 0; i < texels; ++i) {
        map.begins[i + 1] = map.begins[i] + places[i].load(std::memory_order_relaxed);
        places[i].store(map.begins[i], std::memory_order_relaxed);
    }
    map.nodes.resize(map.begins[texels]);
    over_triangles([&](std::size_t texel, const Node& node) {
        map.nodes[places[texel].fetch_add(1, std::memory_order_relaxed)] = node;
    });
    parallel_for(threads, 0, map.rows, [&](std::int64_t row) {
        for (std::int64_t column = 0; column < map.columns; ++column) {
            const auto texel = static_cast<std::size_t>(row * map.columns + column);
            std::sort(map.nodes.begin() + map.begins[texel], map.nodes.begin() + map.begins[texel + 1],
                      [](const Node& a, const Node& b) {
                          return a.depth != b.depth ? a.depth < b.depth : a.triangle < b.triangle;
                      });
        }
    });
    map.tiles.assign(map.tile(map.columns - 1, map.rows - 1) + 1, 0);
    for (int row = 0; row < map.rows; ++row)
        for (int column = 0; column < map.columns; ++column) {
            const auto texel = map.texel(column, row);
            for (auto node = map.begins[texel]; node < map.begins[texel + 1]; ++node)
                map.tiles[map.tile(column, row)] |= std::uint64_t{1} << slab(map.axis, map.nodes[node].depth);
        }
}

/// A ray's way through the texels of a map.
class LayeredDepthCube::March {
  public:
    March(const LayeredDepthCube& cube, const Map& map, const Ray& ray, float far) : map_(&map) {
        const int axes[2] = {(map.axis + 1) % 3, (map.axis + 2) % 3};
        leave_ = far;
        cube.clip(ray, enter_, leave_);
        if (!(enter_ < leave_)) return;
        for (int k = 0; k < 2; ++k) {
            start_[k] = (ray.origin[axes[k]] - map.origin[k]) / cube.texel_;
            step_[k] = ray.direction[axes[k]] / cube.texel_;
            const int last = (k == 0 ? map.columns : map.rows) - 1;
            at_[k] = std::clamp(static_cast<int>(std::floor(start_[k] + enter_ * step_[k])), 0, last);
        }
        find_exit();
    }

    bool is_over() const { return !(enter_ < leave_); }
    const Map& map() const { return *map_; }
    int column() const { return at_[0]; }
    int row() const { return at_[1]; }
    /// Of the ray in this texel, m.
    float enter() const { return enter_; }
    float exit() const { return exit_; }

    void go_on() {
        at_[side_] += step_[side_] > 0 ? 1 : -1;
        const int size = side_ == 0 ? map_->columns : map_->rows;
        enter_ = at_[side_] < 0 || at_[side_] >= size ? leave_ : exit_;
        if (!is_over()) find_exit();
    }

  private:
    void find_exit() {
        float next[2];
        for (int k = 0; k < 2; ++k)
            next[k] = step_[k] == 0
                          ? infinity
                          : (static_cast<float>(at_[k] + (step_[k] > 0 ? 1 : 0)) - start_[k]) / step_[k];
        side_ = next[0] < next[1] ? 0 : 1;
        exit_ = std::clamp(next[side_], enter_, leave_);
    }

    const Map* map_;
    float enter_ = 0, exit_ = 0, leave_ = 0;
    float start_[2], step_[2];  // in texels
    int at_[2] = {0, 0}, side_ = 0;
};

void LayeredDepthCube::clip(const Ray& ray, float& enter, float& leave) const {
    for (int axis = 0; axis < 3; ++axis) {
        const float low = bounds_.min[axis] - margin * texel_, high = bounds_.max[axis] + margin * texel_;
        const float o = ray.origin[axis], d = ray.direction[axis];
        if (d == 0) {
            if (o < low || o > high) leave = enter;
            continue;
        }
        const float a = (low - o) / d, b = (high - o) / d;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
}

Hit LayeredDepthCube::closest_hit(const glm::vec3& origin, const glm::vec3& direction, float far) const {
    const Ray ray{origin, direction};
    Hit nearest;
    if (indices_.empty()) return nearest;
    nearest.distance = std::nextafter(far, infinity);
    const float pad = options_.tolerance * texel_;
    if (options_.maps == CubeMaps::closest) {
        for (March march(*this, maps_[longest_axis(direction)], ray, far);
             !march.is_over() && march.enter() - pad < nearest.distance; march.go_on())
            look_at(march, ray, nearest);
    } else {
        // In step, so that none goes on where another has found something.
        March marches[3] = {
            {*this, maps_[0], ray, far}, {*this, maps_[1], ray, far}, {*this, maps_[2], ray, far}};
        const auto is_before = [](const March& a, const March& b) {
            return (a.is_over() ? infinity : a.enter()) < (b.is_over() ? infinity : b.enter());
        };
        while (true) {
            auto& march = *std::min_element(marches, marches + 3, is_before);
            if (march.is_over() || !(march.enter() - pad < nearest.distance)) break;
            look_at(march, ray, nearest);
            march.go_on();
        }
    }
    return nearest.distance <= far ? nearest : Hit{};
}

std::size_t LayeredDepthCube::slab(int axis, float depth) const {
    const float size = bounds_.max[axis] - bounds_.min[axis] + texel_;
    return static_cast<std::size_t>(
        std::clamp(slabs * (depth - bounds_.min[axis]) / size, 0.0f, slabs - 1.0f));
}

void LayeredDepthCube::look_at(const March& march, const Ray& ray, Hit& nearest) const {
    const auto& map = march.map();
    const float o = ray.origin[map.axis], d = ray.direction[map.axis];
    const float reach = (options_.maps == CubeMaps::all ? depth_reach : options_.tolerance) * texel_;
    const float first = o + march.enter() * d, last = o + march.exit() * d;
    const float low = std::min(first, last) - reach, high = std::max(first, last) + reach;
    const auto low_slab = slab(map.axis, low), high_slab = slab(map.axis, high);
    const auto asked = (~std::uint64_t{0} >> (63 - (high_slab - low_slab))) << low_slab;
    if ((map.tiles[map.tile(march.column(), march.row())] & asked) == 0) return;
    const auto texel = map.texel(march.column(), march.row());
    const auto begin = map.nodes.begin() + map.begins[texel], end = map.nodes.begin() + map.begins[texel + 1];
    for (auto node =
             std::lower_bound(begin, end, low, [](const Node&n, float depth) { return n.depth < depth; });
         node != end && node->depth <= high; ++node)
        if (const auto hit = meet(ray, *node, march.enter(), march.exit()); hit.distance < nearest.distance)
            nearest = hit;
}

Hit LayeredDepthCube::meet(const Ray& ray, const Node& node, float enter, float leave) const {
    const auto& a = corner(node.triangle, 0);
    const auto ab = corner(node.triangle, 1) - a, ac = corner(node.triangle, 2) - a;
    const auto normal = glm::cross(ab, ac);
    const float slope = glm::dot(normal, ray.direction);
    if (slope == 0) return {};
    float distance = glm::dot(normal, a - ray.origin) / slope;
    const float pad = options_.tolerance * texel_;
    const bool is_in_texel = distance >= enter - pad && distance <= leave + pad;
    if (!is_in_texel && options_.maps == CubeMaps::all) return {};
    distance = std::clamp(distance, enter - pad, leave + pad);
    const auto from_a = ray.origin + distance * ray.direction - a;
    const float area = glm::dot(normal, normal);
    float u = glm::dot(glm::cross(from_a, ac), normal) / area,
          v = glm::dot(glm::cross(ab, from_a), normal) / area;
    const bool is_on_triangle = is_in_texel && u >= 0 && v >= 0 && u + v <= 1;
    if (!(distance > 0) || (distance < near_texels * texel_ && !is_on_triangle)) return {};
    u = std::max(u, 0.0f);
    v = std::max(v, 0.0f);
    if (u + v > 1) {
        const float sum = u + v;
        u /= sum;
        v /= sum;
    }
    if (!is_there(node.triangle, u, v)) return {};
    return {distance, node.triangle, u, v};
}

graph::ObjectRef layered_depth_cube(graph::GraphBuilder& builder, const CubeOptions& options) {
    graph::ObjectDesc desc;
    desc.text.key = "raytracing.cube";
    if (const auto found = graph::declared_object(builder, desc.text.key)) return *found;
    desc.text.label = "Layered depth cube";
    desc.text.doc =
        "Three layered depth maps along the axes of the world, with the triangles of their nodes.";
    if (const auto& geometry = builder.inputs().geometry_fingerprint; !geometry.empty()) {
        std::ostringstream text;
        text << std::hexfloat << geometry << " cube " << options.resolution << ' '
             << static_cast<int>(options.maps) << ' ' << options.tolerance;
        desc.fingerprint = text.str();
    }
    const auto result = builder.object(desc);
    builder.pass("layered depth cube", graph::Queue::cpu)
        .writes(result)
        .execute([result, options](graph::PassContext& context) {
            const auto& inputs = context.inputs();
            const auto made =
                std::make_shared<LayeredDepthCube>(*inputs.scene, *inputs.world, options, inputs.threads);
            context.store(result, made, made->bytes());
        });
    return result;
}

}  // namespace ir::passes
