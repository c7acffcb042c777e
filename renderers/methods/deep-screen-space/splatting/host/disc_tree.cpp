#include "renderers/methods/deep-screen-space/splatting/host/disc_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderers/passes/ldm/host/vectors.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderers/methods/deep-screen-space/splatting/host/disc_tree.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ir::methods::deep_screen_space::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, DiscTree::fan>;
using Floats = hn::Vec<FloatTag>;

constexpr FloatTag f;
constexpr std::size_t lanes = hn::MaxLanes(FloatTag());
/// Relative, of bounds: discs are tested as the device does it, boxes may only not lose them.
constexpr float widened = 1 + 1e-4f;

/// What one ray asks of one level.
struct Question {
    glm::vec3 origin, per_direction;
    float near, far;
    float disc;          ///< radius, in radii of a surfel
    float shell, least;  ///< of a surfel the shell ends at the larger of radius · shell and least, m
    float whole;         ///< m: no shell ends farther out
    float inner;         ///< part of the shell's end at which it begins
    bool is_open;        ///< it ends at `whole`
};

Floats set(float value) {
    return hn::Set(f, value);
}

/// Of the boxes first + i, i < 4, the ones whose discs the ray may meet: bit i; entry[i]: from where on.
unsigned met(const Question& q, const DiscTree& tree, const DiscTree::Height& height, std::size_t first,
             float* entry) {
    unsigned result = 0;
    for (std::size_t part = 0; part < DiscTree::fan; part += lanes) {
        const auto load = [&](const std::vector<float>& of) {
            return hn::LoadU(f, of.data() + first + part);
        };
        auto enter = set(q.near), leave = set(q.far), nearest = hn::Zero(f), farthest = hn::Zero(f);
        for (int axis = 0; axis < 3; ++axis) {
            const auto origin = set(q.origin[axis]), scale = set(q.per_direction[axis]);
            const auto low = hn::Sub(load(height.low[axis]), origin),
                       high = hn::Sub(load(height.high[axis]), origin);
            const auto margin = hn::MulAdd(load(height.reach[axis]), set(q.disc), set(tree.rounding));
            const auto a = hn::Mul(hn::Sub(low, margin), scale), b = hn::Mul(hn::Add(high, margin), scale);
            enter = hn::Max(enter, hn::Min(a, b));
            leave = hn::Min(leave, hn::Max(a, b));
            const auto gap = hn::Max(hn::Max(low, hn::Neg(high)), hn::Zero(f));
            nearest = hn::MulAdd(gap, gap, nearest);
            const auto across = hn::Max(hn::Abs(low), hn::Abs(high));
            farthest = hn::MulAdd(across, across, farthest);
        }
        const auto end_of = [&](Floats radius) {
            return hn::Min(hn::Max(hn::Mul(radius, set(q.shell)), set(q.least)), set(q.whole));
        };
        const auto most = load(height.most_radius);
        const auto end = hn::Mul(q.is_open ? set(q.whole) : end_of(most), set(widened));
        const auto begin = hn::Mul(end_of(load(height.least_radius)), set(q.inner));
        auto is_met = hn::And(hn::Le(enter, hn::Mul(leave, set(widened))), hn::Gt(most, hn::Zero(f)));
        is_met = hn::And(is_met, hn::Le(nearest, hn::Mul(end, end)));
        is_met = hn::And(is_met, hn::Ge(farthest, hn::Mul(begin, begin)));
        hn::StoreU(enter, f, entry + part);
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(f, is_met, bits);
        result |= (bits[0] & ((1u << lanes) - 1)) << part;
    }
    return result;
}

Question question_of(const DiscTree& tree, const DiscRay& ray, int level, float near, float far) {
    const auto& influence = tree.rules.influence;
    const float per_radius = influence.trade_off > 0 ? 1 / std::sqrt(influence.trade_off) : 0;
    Question q{.origin = ray.receiver.x_ws,
               .per_direction = glm::vec3(0),
               .near = near,
               .far = far,
               .disc = splat_disc_radius(tree.rules, level, 1) * widened,
               .shell = std::ldexp(per_radius, level),
               .least = std::ldexp(influence.shell_radius, level),
               .whole = influence.whole_reach,
               .inner = tree.rules.full_discs || level == 0 ? 0 : 0.5f / widened,
               .is_open = level == influence.open_level};
    constexpr float least = 1e-20f;
    for (int axis = 0; axis < 3; ++axis) {
        const float part = ray.direction_ws[axis];
        q.per_direction[axis] = 1 / (std::abs(part) > least ? part : least);
    }
    return q;
}

}  // namespace

void search(const DiscTree& tree, DiscRay& ray, int level, std::uint32_t cell, float near, float far) {
    constexpr auto fan = DiscTree::fan;
    auto q = question_of(tree, ray, level, near, far);
    const auto test = [&](std::size_t index) {
        if (index >= tree.surfels.size() || tree.surfels[index].radius == 0) return;
        if (!take(ray, tree.surfels, tree.rules, level, static_cast<std::uint32_t>(index))) return;
        const float t = splat_plane_distance(ray.receiver.x_ws, ray.direction_ws, tree.surfels[index]);
        q.far =
            std::min(q.far, t * widened + tree.rounding);  // of one plane others are as far but for rounding
    };
    // On level 0 all discs of the lowest boxes are of the sub-image.
    const auto lowest = static_cast<std::size_t>(std::max(level, 1)) - 1;
    if (lowest >= tree.heights.size()) return test(cell);  // fewer surfels than sub-images
    struct Waiting {
        std::size_t first, height;
        float entry;
    };
    Waiting stack[3 * 16 + 1];  // four boxes take one's place on each of 16 heights
    int waiting = 0;
    stack[waiting++] = {0, tree.heights.size() - 1, near};
    while (waiting > 0) {
        const auto next = stack[--waiting];
        if (next.entry > q.far) continue;
        float entry[fan];
        const auto bits = met(q, tree, tree.heights[next.height], next.first, entry);
        std::size_t order[fan], count = 0;  // near ones first
        for (std::size_t i = 0; i < fan; ++i) {
            if ((bits >> i & 1) == 0) continue;
            auto place = count++;
            for (; place > 0 && entry[order[place - 1]] > entry[i]; --place) order[place] = order[place - 1];
            order[place] = i;
        }
        if (next.height > lowest) {
            for (auto i = count; i-- > 0;)
                stack[waiting++] = {fan * (next.first + order[i]), next.height - 1, entry[order[i]]};
            continue;
        }
        for (std::size_t i = 0; i < count; ++i) {
            if (entry[order[i]] > q.far) break;
            const auto box = next.first + order[i];
            if (level > 0)
                test((box << 2 * level) + cell);
            else
                for (std::size_t k = 0; k < fan; ++k) test(fan * box + k);
        }
    }
}

}  // namespace ir::methods::deep_screen_space::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ir::methods::deep_screen_space {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Four surfels each.
DiscTree::Height lowest_boxes(std::span<const Surfel> surfels) {
    DiscTree::Height height((surfels.size() + DiscTree::fan - 1) / DiscTree::fan);
    for (std::size_t i = 0; i < surfels.size(); ++i) {
        const auto& s = surfels[i];
        if (s.radius == 0) continue;  // there is a hole
        const auto box = i / DiscTree::fan;
        const auto sines = glm::sqrt(glm::max(1.0f - s.normal_ws * s.normal_ws, glm::vec3(0)));
        for (int axis = 0; axis < 3; ++axis) {
            auto &low = height.low[axis][box], &high = height.high[axis][box],
                 &reach = height.reach[axis][box];
            low = std::min(low, s.centre_ws[axis]);
            high = std::max(high, s.centre_ws[axis]);
            reach = std::max(reach, s.radius * (sines[axis] + 1e-3f));
        }
        height.least_radius[box] = std::min(height.least_radius[box], s.radius);
        height.most_radius[box] = std::max(height.most_radius[box], s.radius);
    }
    return height;
}

DiscTree::Height boxes_about(const DiscTree::Height& parts) {
    DiscTree::Height height(parts.size() / DiscTree::fan);
    const auto fold = [](const std::vector<float>& from, std::vector<float>& to, const auto& choose) {
        for (std::size_t i = 0; i < from.size(); ++i) {
            auto& value = to[i / DiscTree::fan];
            value = choose(value, from[i]);
        }
    };
    const auto least = [](float a, float b) { return std::min(a, b); };
    const auto most = [](float a, float b) { return std::max(a, b); };
    for (int axis = 0; axis < 3; ++axis) {
        fold(parts.low[axis], height.low[axis], least);
        fold(parts.high[axis], height.high[axis], most);
        fold(parts.reach[axis], height.reach[axis], most);
    }
    fold(parts.least_radius, height.least_radius, least);
    fold(parts.most_radius, height.most_radius, most);
    return height;
}

}  // namespace

DiscTree::Height::Height(std::size_t boxes) {
    const auto padded = (boxes + fan - 1) / fan * fan;
    for (int axis = 0; axis < 3; ++axis) {
        low[axis].assign(padded, infinity);
        high[axis].assign(padded, -infinity);
        reach[axis].assign(padded, 0);
    }
    least_radius.assign(padded, infinity);
    most_radius.assign(padded, 0);
}

bool DiscTree::fits(std::span<const Surfel> surfels) {
    for (std::size_t i = 0; i < surfels.size(); ++i)
        if (surfels[i].order != i) return false;
    return true;
}

DiscTree::DiscTree(std::span<const Surfel> all, const VisibleLevel& level_rules)
    : surfels(all), rules(level_rules) {
    if (surfels.empty()) return;
    heights.push_back(lowest_boxes(surfels));
    while (heights.back().size() > fan) heights.push_back(boxes_about(heights.back()));
    float size = 0;
    for (std::size_t i = 0; i < fan; ++i)
        for (int axis = 0; axis < 3 && heights.back().most_radius[i] > 0; ++axis)
            size = std::max(
                {size, std::abs(heights.back().low[axis][i]), std::abs(heights.back().high[axis][i])});
    rounding = 1e-6f * size;
}

HWY_EXPORT(search);

void ask(const DiscTree& tree, DiscRay& ray, int level, std::uint32_t cell, float near, float far) {
    near = std::max(0.99f * ray.known, near);
    if (tree.heights.empty() || !(near < far)) return;
    HWY_DYNAMIC_DISPATCH(search)(tree, ray, level, cell, near, far);
}

}  // namespace ir::methods::deep_screen_space
#endif
