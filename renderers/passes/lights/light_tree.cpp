#include "renderers/passes/lights/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderers/passes/raytracing/ray_offset.h"

namespace ir::passes {
namespace {

glm::vec3 centre_of(const LightBounds& bounds) {
    return 0.5f * (bounds.min + bounds.max);
}

/// cos and sin of max(0, a - b) for angles from 0 to π, given by their own.
struct Angle {
    float cosine, sine;
};
Angle reduced(Angle a, Angle b) {
    if (a.cosine >= b.cosine) return {1, 0};
    return {a.cosine * b.cosine + a.sine * b.sine, a.sine * b.cosine - a.cosine * b.sine};
}

Angle with_cosine(float cosine) {
    return {cosine, std::sqrt(std::max(1 - cosine * cosine, 0.0f))};
}

}  // namespace

struct LightTree::Builder {
    using Items = std::vector<std::uint32_t>;
    using Iterator = Items::iterator;
    static constexpr int buckets = 12;

    const std::vector<LightBounds>& lights;
    LightTree& tree;

    std::uint32_t build(Iterator begin, Iterator end, std::uint32_t parent) {
        LightBounds all;
        for (auto i = begin; i != end; ++i) all = merged(all, lights[*i]);
        const auto index = static_cast<std::uint32_t>(tree.nodes_.size());
        tree.nodes_.push_back(node_of(all, parent));
        if (end - begin == 1) {
            tree.nodes_[index].light = *begin;
            tree.leaves_[*begin] = index;
            return index;
        }
        const auto middle = split(begin, end, all);
        build(begin, middle, index);
        const auto right = build(middle, end, index);
        tree.nodes_[index].right = right;
        return index;
    }

    static Node node_of(const LightBounds& bounds, std::uint32_t parent) {
        Node node;
        node.centre = centre_of(bounds);
        // A little more than the box, so that rounding leaves nothing out.
        const float radius = 1.0001f * bounds.half_diagonal();
        node.squared_radius = radius * radius;
        node.axis = bounds.axis;
        node.intensity = bounds.intensity;
        const auto cone = with_cosine(bounds.cos_normals);
        node.cos_normals = cone.cosine;
        node.sin_normals = cone.sine;
        node.cos_emission = bounds.cos_emission;
        node.two_sided = bounds.two_sided;
        node.parent = parent;
        return node;
    }

    struct Split {
        float cost = HUGE_VALF;
        int axis = 0, bucket = 0;
    };

    int bucket_of(std::uint32_t item, int axis, glm::vec3 low, glm::vec3 size) const {
        const float place = (centre_of(lights[item])[axis] - low[axis]) / size[axis];
        return std::clamp(static_cast<int>(place * buckets), 0, buckets - 1);
    }

    /// The cheapest of the splits between buckets along an axis.  [Conty18 §4.4]
    Split best_along(int axis, Iterator begin, Iterator end, glm::vec3 low, glm::vec3 size) const {
        std::array<LightBounds, buckets> groups{};
        for (auto i = begin; i != end; ++i) {
            auto& group = groups[static_cast<std::size_t>(bucket_of(*i, axis, low, size))];
            group = merged(group, lights[*i]);
        }
        std::array<LightBounds, buckets> above{};
        above[buckets - 1] = groups[buckets - 1];
        for (std::size_t b = buckets - 1; b > 0; --b) above[b - 1] = merged(above[b], groups[b - 1]);
        const float longest = std::max({size.x, size.y, size.z});
        Split best{HUGE_VALF, axis, 0};
        LightBounds below;
        for (std::size_t b = 0; b + 1 < buckets; ++b) {
            below = merged(below, groups[b]);
            if (!(below.intensity > 0) || !(above[b + 1].intensity > 0)) continue;
            // Thin boxes are better cut across.
            const float cost = longest / size[axis] * (split_cost(below) + split_cost(above[b + 1]));
            if (cost < best.cost) best = {cost, axis, static_cast<int>(b)};
        }
        return best;
    }

    Iterator split(Iterator begin, Iterator end, const LightBounds&) const {
        glm::vec3 low(HUGE_VALF), high(-HUGE_VALF);
        for (auto i = begin; i != end; ++i) {
            low = glm::min(low, centre_of(lights[*i]));
            high = glm::max(high, centre_of(lights[*i]));
        }
        const auto size = high - low;
        Split best;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(size[axis] > 0)) continue;
            const auto candidate = best_along(axis, begin, end, low, size);
            if (candidate.cost < best.cost) best = candidate;
        }
        if (best.cost == HUGE_VALF) return begin + (end - begin) / 2;  // all in one place
        return std::partition(begin, end, [&](std::uint32_t item) {
            return bucket_of(item, best.axis, low, size) <= best.bucket;
        });
    }
};

LightTree::LightTree(const std::vector<LightBounds>& lights) : leaves_(lights.size(), none) {
    Builder::Items items;
    for (std::uint32_t i = 0; i < lights.size(); ++i)
        if (lights[i].intensity > 0) items.push_back(i);
    if (items.empty()) return;
    nodes_.reserve(2 * items.size());
    Builder{lights, *this}.build(items.begin(), items.end(), none);
}

/// Bound of the irradiance from the group: intensity * cos θ' * cos θi' / distance², the angles the least
/// that any of its lights may have.  [Conty18 §5]
float LightTree::importance(const Node& node, glm::vec3 position_ws, glm::vec3 normal_ws) const {
    constexpr float min_squared_distance = 1e-16f;  // keeps the quotient finite
    const auto offset = position_ws - node.centre;
    const float squared = glm::dot(offset, offset);
    if (squared <= node.squared_radius)
        return node.intensity / std::max(node.squared_radius, min_squared_distance);
    const auto direction = offset / std::sqrt(squared);
    const float sine_squared = node.squared_radius / squared;
    const Angle box{std::sqrt(1 - sine_squared), std::sqrt(sine_squared)};
    float cosine = glm::dot(node.axis, direction);
    if (node.two_sided != 0) cosine = std::abs(cosine);
    const auto beyond_normals = reduced(with_cosine(cosine), {node.cos_normals, node.sin_normals});
    const float cos_emitted = reduced(beyond_normals, box).cosine;
    if (cos_emitted <= node.cos_emission) return 0;
    float result = node.intensity * cos_emitted / std::max(squared, min_squared_distance);
    if (normal_ws != glm::vec3(0))
        result *= std::max(reduced(with_cosine(-glm::dot(direction, normal_ws)), box).cosine, 0.0f);
    return result;
}

std::optional<LightTree::Choice> LightTree::choose(glm::vec3 position_ws, glm::vec3 normal_ws,
                                                   double u) const {
    if (nodes_.empty()) return std::nullopt;
    if (nodes_[0].right == none && !(importance(nodes_[0], position_ws, normal_ws) > 0)) return std::nullopt;
    std::uint32_t at = 0;
    float probability = 1;
    while (nodes_[at].right != none) {
        const auto right = nodes_[at].right;
        const float a = importance(nodes_[at + 1], position_ws, normal_ws);
        const float b = importance(nodes_[right], position_ws, normal_ws);
        if (!(a + b > 0)) return std::nullopt;
        const float part = a / (a + b);
        if (u < part) {
            u /= part;
            probability *= part;
            at = at + 1;
        } else {
            u = (u - part) / (1 - part);
            probability *= b / (a + b);
            at = right;
        }
    }
    if (!(probability > 0)) return std::nullopt;
    return Choice{nodes_[at].light, probability};
}

float LightTree::probability(glm::vec3 position_ws, glm::vec3 normal_ws, std::uint32_t light) const {
    auto at = light < leaves_.size() ? leaves_[light] : none;
    if (at == none) return 0;
    if (nodes_[at].parent == none && !(importance(nodes_[at], position_ws, normal_ws) > 0)) return 0;
    float probability = 1;
    while (nodes_[at].parent != none) {
        const auto parent = nodes_[at].parent;
        const auto sibling = at == parent + 1 ? nodes_[parent].right : parent + 1;
        const float own = importance(nodes_[at], position_ws, normal_ws);
        if (!(own > 0)) return 0;
        probability *= own / (own + importance(nodes_[sibling], position_ws, normal_ws));
        at = parent;
    }
    return probability;
}

std::uint32_t LightTree::after(std::uint32_t node) const {
    for (auto at = node; nodes_[at].parent != none; at = nodes_[at].parent)
        if (const auto right = nodes_[nodes_[at].parent].right; right != at) return right;
    return none;
}

bool LightTree::may_meet(glm::vec3 origin_ws, glm::vec3 direction_ws) const {
    // More than eight offsets of rays, as panes move them, and rounding.
    constexpr float least = 8 * min_ray_offset_m, room = 1e-4f;
    for (std::uint32_t at = nodes_.empty() ? none : 0; at != none;) {
        const auto& node = nodes_[at];
        const auto offset = node.centre - origin_ws;
        const float reach =
            std::sqrt(node.squared_radius) + least + room * (glm::length(offset) + glm::length(node.centre));
        // where the ray comes closest to the centre
        const auto closest = offset - std::max(glm::dot(offset, direction_ws), 0.0f) * direction_ws;
        const bool is_met = glm::dot(closest, closest) <= reach * reach;
        if (is_met && node.right == none) return true;
        at = is_met ? at + 1 : after(at);
    }
    return false;
}

}  // namespace ir::passes
