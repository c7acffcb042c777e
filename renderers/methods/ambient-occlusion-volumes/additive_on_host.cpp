// The additive form on the host's threads: each tile of the picture goes through the triangles whose volumes
// may reach it. volume.glsl, form_factor.glsl and occlusion.glsl say the same for the device.
#include <algorithm>
#include <array>
#include <cmath>

#include "renderers/core/constants.h"
#include "renderers/core/half_float.h"
#include "renderers/core/parallel_for.h"
#include "renderers/methods/ambient-occlusion-volumes/volumes.h"
#include "renderers/passes/bounce/host/host_receivers.h"
#include "renderers/passes/raytracing/ray_offset.h"
#include "renderers/passes/surface/triangle_plane.h"
#include "shaders/methods/ambient-occlusion-volumes/triangle.glsl.h"

namespace ir::methods::ambient_occlusion_volumes {
namespace {

constexpr int side = 8;  ///< pixels, of a tile
constexpr int max_points = side * side;

struct Box {
    glm::vec3 low{infinity}, high{-infinity};
    void add(glm::vec3 p) { low = glm::min(low, p), high = glm::max(high, p); }
    bool meets(const Box& other) const {
        return glm::all(glm::lessThanEqual(low, other.high)) &&
               glm::all(glm::greaterThanEqual(high, other.low));
    }
};

/// The region within which a triangle occludes, as in volume.glsl.
struct Volume {
    glm::vec3 corners[3], normal, edge_normals[3], bisectors[3];
    float coverage;

    Volume(glm::vec3 a, glm::vec3 b, glm::vec3 c, float covered)
        : corners{a, b, c}, normal(passes::triangle_normal(a, b, c)), coverage(covered) {
        const glm::vec3 edges[3] = {glm::normalize(b - a), glm::normalize(c - b), glm::normalize(a - c)};
        for (int i = 0; i < 3; ++i) edge_normals[i] = glm::normalize(glm::cross(edges[i], normal));
        for (int i = 0; i < 3; ++i) {
            const int before = (i + 2) % 3;
            bisectors[i] = glm::normalize(edge_normals[before] + edge_normals[i] + edges[before] - edges[i]);
        }
    }
    /// A point of the volume lies at most √2 `reach` from a corner in the triangle's plane, and `reach` above
    /// it.
    Box box(float reach) const {
        Box result;
        for (const auto& corner : corners) result.add(corner);
        const glm::vec3 margin(1.74f * reach);  // √3, and rounding
        return {result.low - margin, result.high + margin};
    }
};

/// The points that a tile of the picture shows.
struct Points {
    int count = 0;
    std::array<float, max_points> x, y, z;  ///< where their rays would start
    std::array<glm::vec3, max_points> normal;
    std::array<std::size_t, max_points> pixel;
    Box box;
    glm::vec3 at(int i) const {
        const auto k = static_cast<std::size_t>(i);
        return {x[k], y[k], z[k]};
    }
};

float edge_term(glm::vec3 p, glm::vec3 q, glm::vec3 n) {
    const auto moment = glm::cross(p, q - p);
    const float size = glm::length(moment);
    return size > 0 ? std::atan2(size, glm::dot(p, q)) * glm::dot(n, moment) / size : 0;
}

/// Of the triangle's part above the plane through the origin with the normal n.  [Baum89]
float form_factor(const std::array<glm::vec3, 3>& p, glm::vec3 n) {
    const float above[3] = {glm::dot(p[0], n), glm::dot(p[1], n), glm::dot(p[2], n)};
    std::array<glm::vec3, 4> polygon;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto next = (i + 1) % 3;
        if (above[i] > 0) polygon[count++] = p[i];
        if ((above[i] > 0) != (above[next] > 0))
            polygon[count++] = glm::mix(p[i], p[next], above[i] / (above[i] - above[next]));
    }
    float sum = 0;
    for (std::size_t i = 0; i < count; ++i)
        sum += edge_term(polygon[i], polygon[i + 1 < count ? i + 1 : 0], n);
    return -sum / (2 * pi);
}

class Adder {
  public:
    Adder(const graph::PassContext& context, const Volumes& volumes, Transport::Falloff falloff,
          graph::ImageRef sum)
        : view_(context.inputs().view),
          positions_(context.pixels<const glm::vec4>(volumes.gbuffer.position)),
          geometric_normals_(context.pixels<const glm::vec4>(volumes.gbuffer.geometric_normal)),
          normals_(context.pixels<const std::uint64_t>(volumes.gbuffer.normal)),
          sums_(context.pixels<float>(sum)),
          reach_(volumes.reach),
          both_sides_(volumes.both_sides),
          is_hard_(falloff == Transport::Falloff::hard) {}

    void add(const std::vector<Volume>& volumes, const std::vector<Box>& boxes, std::int64_t tile) const {
        const auto points = points_of(tile);
        std::array<float, max_points> sums{};
        if (points.count > 0)
            for (std::size_t i = 0; i < volumes.size(); ++i)
                if (boxes[i].meets(points.box) && may_meet(volumes[i], points.box))
                    add(volumes[i], points, sums);
        for (int i = 0; i < points.count; ++i)
            sums_[points.pixel[static_cast<std::size_t>(i)]] = sums[static_cast<std::size_t>(i)];
    }

  private:
    Points points_of(std::int64_t tile) const {
        Points points;
        const int across = (view_.width + side - 1) / side;
        const int left = static_cast<int>(tile % across) * side, top = static_cast<int>(tile / across) * side;
        for (int y = top; y < std::min(top + side, view_.height); ++y)
            for (int x = left; x < std::min(left + side, view_.width); ++x) {
                const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.width) +
                                   static_cast<std::size_t>(x);
                sums_[pixel] = 0;
                const glm::vec3 normal(geometric_normals_[pixel]);
                if (normal == glm::vec3(0)) continue;
                const auto k = static_cast<std::size_t>(points.count++);
                const auto origin = passes::offset_origin(positions_[pixel], normal);
                points.x[k] = origin.x, points.y[k] = origin.y, points.z[k] = origin.z;
                points.normal[k] =
                    passes::bounce::shading_normal(glm::vec3(unpack_halves(normals_[pixel])), normal);
                points.pixel[k] = pixel;
                points.box.add(origin);
            }
        return points;
    }

    /// False where one of the volume's planes lies between it and the whole box.
    bool may_meet(const Volume& v, const Box& box) const {
        const auto middle = 0.5f * (box.low + box.high), half = 0.5f * (box.high - box.low);
        const float slack = 1e-3f * reach_;
        const auto least = [&](glm::vec3 axis, glm::vec3 from) {
            return glm::dot(axis, middle - from) - glm::dot(glm::abs(axis), half) - slack;
        };
        if (least(v.normal, v.corners[0]) > reach_ ||
            least(-v.normal, v.corners[0]) > (both_sides_ ? reach_ : 0))
            return false;
        for (int i = 0; i < 3; ++i)
            if (least(v.edge_normals[i], v.corners[i]) > reach_ ||
                least(v.bisectors[i], v.corners[i]) > reach_)
                return false;
        return true;
    }

    void add(const Volume& v, const Points& points, std::array<float, max_points>& sums) const {
        std::array<float, max_points> height, excess;
        const auto beyond = [&](glm::vec3 axis, glm::vec3 from, std::size_t i) {
            return axis.x * (points.x[i] - from.x) + axis.y * (points.y[i] - from.y) +
                   axis.z * (points.z[i] - from.z);
        };
        const auto count = static_cast<std::size_t>(points.count);
        for (std::size_t i = 0; i < count; ++i) {
            height[i] = beyond(v.normal, v.corners[0], i);
            excess[i] = std::abs(height[i]);
        }
        for (int k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < count; ++i)
                excess[i] = std::max(excess[i], std::max(beyond(v.edge_normals[k], v.corners[k], i),
                                                         beyond(v.bisectors[k], v.corners[k], i)));
        for (std::size_t i = 0; i < count; ++i) {
            if (!(excess[i] <= reach_) || (!both_sides_ && height[i] < 0)) continue;
            const auto x = points.at(static_cast<int>(i));
            const float f =
                form_factor({v.corners[0] - x, v.corners[1] - x, v.corners[2] - x}, points.normal[i]);
            sums[i] += v.coverage * falloff_weight(v, height[i], x) * (height[i] < 0 ? -f : f);
        }
    }

    float falloff_weight(const Volume& v, float height, glm::vec3 x) const {
        if (is_hard_) return 1;
        float g = 1 - std::abs(height) / reach_;
        for (int i = 0; i < 3; ++i)
            g *= std::clamp(1 - glm::dot(v.edge_normals[i], x - v.corners[i]) / reach_, 0.0f, 1.0f);
        return std::max(g, 0.0f);
    }

    const scene::View& view_;
    std::span<const glm::vec4> positions_, geometric_normals_;
    std::span<const std::uint64_t> normals_;
    std::span<float> sums_;
    float reach_;
    bool both_sides_, is_hard_;
};

/// Those that are drawn.
std::vector<Volume> drawn_volumes(const graph::PassContext& context, const Volumes& volumes) {
    const auto& world = *context.inputs().world;
    const auto occluders = context.elements<const Occluder>(volumes.occluders);
    std::vector<Volume> result;
    for (std::size_t triangle = 0; triangle < world.triangles(); ++triangle) {
        if (!occluders[triangle].drawn) continue;
        const auto corner = [&](std::size_t i) {
            return glm::vec3(world.positions[world.indices[3 * triangle + i]]);
        };
        result.emplace_back(corner(0), corner(1), corner(2), occluders[triangle].coverage);
    }
    return result;
}

}  // namespace

void add_up_on_host(graph::GraphBuilder& builder, const Volumes& volumes, Transport::Falloff falloff,
                    graph::ImageRef sum) {
    struct Drawn {
        std::vector<Volume> volumes;
        std::vector<Box> boxes;
    };
    const auto drawn = std::make_shared<Drawn>();
    const auto& view = builder.inputs().view;
    const auto tiles = std::int64_t{(view.width + side - 1) / side} * ((view.height + side - 1) / side);
    const auto& g = volumes.gbuffer;
    builder.pass("additive", graph::Queue::cpu)
        .has_two_bodies()
        .reads(volumes.occluders, g.position, g.normal, g.geometric_normal)
        .writes(sum)
        .execute_sliced(tiles, [=](graph::PassContext& context, graph::Slice slice) {
            if (slice.first) {
                drawn->volumes = drawn_volumes(context, volumes);
                drawn->boxes.clear();
                for (const auto& volume : drawn->volumes) drawn->boxes.push_back(volume.box(volumes.reach));
            }
            const Adder adder(context, volumes, falloff, sum);
            parallel_for(context.inputs().threads, slice.begin, slice.end,
                         [&](std::int64_t tile) { adder.add(drawn->volumes, drawn->boxes, tile); });
        });
}

}  // namespace ir::methods::ambient_occlusion_volumes
