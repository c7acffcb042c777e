#include "renderers/passes/lights/light_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace ir::passes {
namespace {

glm::vec3 centre_of(const LightBounds& bounds) {
    return 0.5f * (bounds.min + bounds.max);
}

}  // namespace

/// First a tree of pairs, by where cutting is cheapest; then groups of what is near in it.
struct LightTree::Builder {
    using Items = std::vector<std::uint32_t>;
    using Iterator = Items::iterator;
    static constexpr int buckets = 12;

    struct Pair {
        LightBounds bounds;
        std::uint32_t left = none, right = none;
        std::uint32_t light = none;  ///< of leaves
    };

    const std::vector<LightBounds>& lights;
    LightTree& tree;
    std::vector<Pair> pairs{};

    std::uint32_t build(Iterator begin, Iterator end) {
        const auto index = static_cast<std::uint32_t>(pairs.size());
        pairs.emplace_back();
        for (auto i = begin; i != end; ++i) pairs[index].bounds = merged(pairs[index].bounds, lights[*i]);
        if (end - begin == 1) {
            pairs[index].light = *begin;
            return index;
        }
        const auto middle = split(begin, end);
        const auto left = build(begin, middle), right = build(middle, end);
        pairs[index].left = left;
        pairs[index].right = right;
        return index;
    }

    /// How much is said by opening it: nothing of leaves.
    static float extent(const Pair& pair) {
        const float radius = pair.bounds.half_diagonal();
        return pair.light == none ? pair.bounds.intensity * (radius * radius) : -1;
    }

    /// As many of a subtree as one group holds, the greatest opened first.
    Items members_of(std::uint32_t root) const {
        Items members{root};
        while (members.size() < LightGroup::capacity) {
            const auto greatest = std::ranges::max_element(
                members, {}, [&](std::uint32_t member) { return extent(pairs[member]); });
            const auto& opened = pairs[*greatest];
            if (opened.light != none) break;
            *greatest = opened.left;
            members.push_back(opened.right);
        }
        return members;
    }

    void group_pairs() {
        tree.groups_.emplace_back();
        for (Items roots{0}; tree.groups_.size() > done; ++done) {
            const auto members = members_of(roots[done]);
            for (const auto member : members) add(member, roots);
        }
    }
    std::uint32_t done = 0;

    void add(std::uint32_t index, Items& roots) {
        const auto& pair = pairs[index];
        auto& group = tree.groups_[done];
        const Place place{done, group.count++};
        const auto at = static_cast<std::size_t>(place.member);
        put(pair.bounds, at, group);
        group.lights[at] = pair.light;
        group.children[at] = none;
        if (pair.light != none) {
            tree.leaves_[pair.light] = place;
            return;
        }
        group.children[at] = static_cast<std::uint32_t>(roots.size());
        roots.push_back(index);
        tree.groups_.emplace_back().parent = place;
    }

    static void put(const LightBounds& bounds, std::size_t at, LightGroup& group) {
        // A little more than the box, so that rounding leaves nothing out.
        const float radius = 1.0001f * bounds.half_diagonal();
        const auto centre = centre_of(bounds);
        for (int c = 0; c < 3; ++c) {
            group.centre[static_cast<std::size_t>(c)][at] = centre[c];
            group.axis[static_cast<std::size_t>(c)][at] = bounds.axis[c];
        }
        group.squared_radius[at] = radius * radius;
        group.intensity[at] = bounds.intensity;
        group.cos_normals[at] = bounds.cos_normals;
        group.sin_normals[at] = std::sqrt(std::max(1 - bounds.cos_normals * bounds.cos_normals, 0.0f));
        group.cos_emission[at] = bounds.cos_emission;
        group.two_sided[at] = bounds.two_sided ? 1 : 0;
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

    Iterator split(Iterator begin, Iterator end) const {
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

LightTree::LightTree(const std::vector<LightBounds>& lights) : leaves_(lights.size()) {
    Builder::Items items;
    for (std::uint32_t i = 0; i < lights.size(); ++i)
        if (lights[i].intensity > 0) items.push_back(i);
    if (items.empty()) return;
    Builder builder{lights, *this};
    builder.pairs.reserve(2 * items.size());
    builder.build(items.begin(), items.end());
    builder.group_pairs();
}

const LightWeights& LightTree::weights(LightReceiver& receiver, std::uint32_t group) const {
    const bool is_remembered = group < LightReceiver::remembered;
    auto& weights = is_remembered ? receiver.weights_[group] : receiver.others_;
    if (is_remembered && (receiver.known_ >> group & 1) != 0) return weights;
    weigh(groups_[group], receiver.position_ws, receiver.normal_ws, weights);
    if (is_remembered) receiver.known_ |= 1u << group;
    return weights;
}

std::optional<LightTree::Choice> LightTree::choose(LightReceiver& receiver, double u) const {
    constexpr double below_one = 1 - 0x1p-53;
    float probability = 1;
    for (std::uint32_t at = empty() ? none : 0; at != none;) {
        const auto& group = groups_[at];
        const auto& weights = this->weights(receiver, at);
        if (!(weights.sum > 0)) return std::nullopt;
        double left = u * weights.sum, part = 0;
        std::size_t chosen = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(group.count); ++i) {
            if (!(weights.of[i] > 0)) continue;
            left -= part;
            part = weights.of[i];
            chosen = i;
            if (left < part) break;
        }
        u = std::min(left / part, below_one);
        probability *= static_cast<float>(part) / weights.sum;
        if (group.lights[chosen] != none) return Choice{group.lights[chosen], probability};
        at = group.children[chosen];
    }
    return std::nullopt;
}

float LightTree::probability(LightReceiver& receiver, std::uint32_t light) const {
    auto place = light < leaves_.size() ? leaves_[light] : Place{};
    if (place.group == none) return 0;
    float probability = 1;
    for (; place.group != none; place = groups_[place.group].parent) {
        const auto& weights = this->weights(receiver, place.group);
        const float own = weights.of[static_cast<std::size_t>(place.member)];
        if (!(own > 0)) return 0;
        probability *= own / weights.sum;
    }
    return probability;
}

bool LightTree::may_meet(glm::vec3 origin_ws, glm::vec3 direction_ws) const {
    return !empty() && meets(0, origin_ws, direction_ws);
}

bool LightTree::meets(std::uint32_t at, glm::vec3 origin_ws, glm::vec3 direction_ws) const {
    const auto& group = groups_[at];
    for (auto met = passes::may_meet(group, origin_ws, direction_ws); met != 0; met &= met - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(met));
        if (group.lights[i] != none || meets(group.children[i], origin_ws, direction_ws)) return true;
    }
    return false;
}

std::vector<LightNode> LightTree::flattened() const {
    static_assert(LightGroup::capacity <= max_light_children);
    std::vector<LightNode> result(1);
    std::vector<std::uint32_t> nodes(groups_.size());  // of each group the node that stands for it
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        const auto& group = groups_[g];
        result[nodes[g]].first_child = static_cast<std::uint32_t>(result.size());
        result[nodes[g]].children = static_cast<std::uint32_t>(group.count);
        for (std::size_t m = 0; m < static_cast<std::size_t>(group.count); ++m) {
            if (group.children[m] != none)
                nodes[group.children[m]] = static_cast<std::uint32_t>(result.size());
            result.push_back({.centre = {group.centre[0][m], group.centre[1][m], group.centre[2][m]},
                              .squared_radius = group.squared_radius[m],
                              .axis = {group.axis[0][m], group.axis[1][m], group.axis[2][m]},
                              .intensity = group.intensity[m],
                              .cos_normals = group.cos_normals[m],
                              .sin_normals = group.sin_normals[m],
                              .cos_emission = group.cos_emission[m],
                              .two_sided = group.two_sided[m] > 0 ? 1u : 0u,
                              .parent = nodes[g],
                              .source = group.lights[m]});
        }
    }
    return result;
}

}  // namespace ir::passes
