#include "renderers/passes/ldm/host/first_hit.h"

#include <cmath>

#include "shaders/passes/ldm/entry_plane.glsl.h"
#include "shaders/passes/ldm/storage.glsl.h"
#include "shaders/passes/ldm/trace.glsl.h"

namespace ir::passes::ldm {
namespace {

float projected(const glm::vec3& position_ws, const glm::vec4& row) {
    return glm::dot(position_ws, glm::vec3(row)) + row.w;
}

/// Rounded down, for keys.
int quantum(float depth) {
    return static_cast<int>(std::floor(std::clamp(depth, -ldm_max_key, ldm_max_key)));
}

/// The nearest entry beyond `key` along ω; ldm_none_behind or ldm_none_before where there is none.
int next_beyond(std::span<const std::uint16_t> list, int key, bool forward) {
    if (forward) {
        int found = ldm_none_behind;
        for (const int depth : list) found = depth > key ? std::min(found, depth) : found;
        return found;
    }
    int found = ldm_none_before;
    for (const int depth : list) found = depth < key ? std::max(found, depth) : found;
    return found;
}

bool is_entry(int depth) {
    return depth != ldm_none_before && depth != ldm_none_behind;
}

}  // namespace

PointTracer::PointTracer(const StreamedMap& map, const SelfHitRule& rule) : map_(map), rule_(rule) {
    const auto& frame = map.frame;
    slope_u_ = glm::vec3(frame.step_u) / frame.direction.w;
    slope_v_ = glm::vec3(frame.step_v) / frame.direction.w;
    texel_quanta_ = StreamedMap::texel_quanta(frame);
    texel_size_ = texel_quanta_ * frame.direction.w;
}

std::span<const std::uint16_t> PointTracer::list(int column, int row,
                                                 const std::vector<std::uint16_t>& values) const {
    const auto texel = static_cast<std::size_t>(row - map_.first_row) * map_.resolution + column;
    return std::span(values).subspan(map_.begins[texel], map_.begins[texel + 1] - map_.begins[texel]);
}

bool PointTracer::lies_before(const SlopeTest& test, int depth, unsigned codes) const {
    const int ahead = test.forward ? depth - test.key : test.key - depth;
    if (ahead > slope_reach_quanta(texel_quanta_)) return true;
    const auto slope = 0.5f * glm::vec2(map_.slope_of[codes & 0xffu], map_.slope_of[codes >> 8]);
    const float here = static_cast<float>(depth) + glm::dot(slope, test.place);
    return (test.forward ? here - test.depth : test.depth - here) > test.tolerance;
}

int PointTracer::next_by_slopes(int column, int row, const SlopeTest& test) const {
    const auto depths = list(column, row, map_.depths), codes = list(column, row, map_.slopes);
    int found = test.forward ? ldm_none_behind : ldm_none_before;
    for (std::size_t i = 0; i < depths.size(); ++i) {
        const int depth = depths[i];
        if (test.forward ? depth <= test.key || depth >= found : depth >= test.key || depth <= found)
            continue;
        if (lies_before(test, depth, codes[i])) found = depth;
    }
    return found;
}

FirstHit PointTracer::trace_tangent(const glm::vec3& position_ws, const glm::vec3& normal_ws,
                                    bool forward) const {
    const auto& frame = map_.frame;
    const float u = projected(position_ws, frame.u), v = projected(position_ws, frame.v),
                depth = projected(position_ws, frame.depth);
    int column = static_cast<int>(std::floor(u)), row = static_cast<int>(std::floor(v));
    if (is_outside(column, row)) return beside();
    const float facing = std::max(std::abs(glm::dot(normal_ws, glm::vec3(frame.direction))), min_facing);
    // Depth along ω that the tangent plane gains per texel.
    const float slope_x = glm::dot(normal_ws, slope_u_) / -facing,
                slope_y = glm::dot(normal_ws, slope_v_) / -facing;
    const auto gain_at = [&] {
        return slope_x * (static_cast<float>(column) + 0.5f - u) +
               slope_y * (static_cast<float>(row) + 0.5f - v);
    };
    float gain = gain_at();
    // The centre on the other side of x starts above the surface: see trace.glsl.
    if (gain > rule_.max_dip * texel_quanta_) {
        const bool along_u = std::abs(slope_x) > std::abs(slope_y);
        const int back_x = along_u ? (slope_x > 0 ? -1 : 1) : 0;
        const int back_y = along_u ? 0 : (slope_y > 0 ? -1 : 1);
        if (!is_outside(column + back_x, row + back_y)) {
            column += back_x, row += back_y;
            gain = gain_at();
        }
    }
    if (row < map_.first_row || row >= map_.first_row + map_.rows) return {false, false};
    const float tolerance = rule_.quanta + std::min(rule_.slope * (std::abs(slope_x) + std::abs(slope_y)),
                                                    max_tolerance * texel_quanta_);
    const float along = forward ? 1.0f : -1.0f;
    const float plane = depth + along * gain, start = depth + along * std::max(gain + tolerance, 0.0f);
    const int key = forward ? quantum(start) : -quantum(-start);  // down along ω
    const auto next_by_slopes_too = [&] {
        const glm::vec2 place(u - static_cast<float>(column) - 0.5f, v - static_cast<float>(row) - 0.5f);
        const float wide = rule_.quanta + slope_tolerance({slope_x, slope_y}, place, texel_quanta_);
        return next_by_slopes(column, row, {place, depth, wide, key, forward});
    };
    const int found = map_.holds == Holds::sloped_lists
                          ? next_by_slopes_too()
                          : next_beyond(list(column, row, map_.depths), key, forward);
    return {true, is_entry(found), along * (static_cast<float>(found) - plane), column, row, found};
}

FirstHit PointTracer::trace_offset(const glm::vec3& position_ws, const glm::vec3& normal_ws,
                                   bool forward) const {
    const auto& frame = map_.frame;
    const float cosine = glm::dot(normal_ws, glm::vec3(frame.direction));
    const float distance_ws = rule_.offset * texel_size_ * std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    const auto moved = position_ws + distance_ws * normal_ws;
    const int column = static_cast<int>(std::floor(projected(moved, frame.u)));
    const int row = static_cast<int>(std::floor(projected(moved, frame.v)));
    if (is_outside(column, row)) return beside();
    if (row < map_.first_row || row >= map_.first_row + map_.rows) return {false, false};
    const float plane = projected(moved, frame.depth);
    const auto entries = list(column, row, map_.depths);
    // The entry nearest to x, once moved, is its own, and the next one is the hit.
    const int key = -quantum(-plane);
    const int before = next_beyond(entries, key, false), behind = next_beyond(entries, key - 1, true);
    const int own = plane - static_cast<float>(before) < static_cast<float>(behind) - plane ? before : behind;
    if (!is_entry(own)) return {true, false};
    const int found = next_beyond(entries, own, forward);
    return {true, is_entry(found), std::abs(static_cast<float>(found - own)), column, row, found};
}

glm::vec3 PointTracer::project(const glm::vec3& position_ws) const {
    const auto& frame = map_.frame;
    return {projected(position_ws, frame.u), projected(position_ws, frame.v),
            projected(position_ws, frame.depth)};
}

std::optional<int> PointTracer::nearest(int column, int row, float depth, float reach) const {
    if (is_outside(column, row) || !knows(row)) return {};
    std::optional<int> found;
    for (const int entry : list(column, row, map_.depths)) {
        const float gap = std::abs(static_cast<float>(entry) - depth);
        if (gap > reach || (gap == reach && found && entry < *found))
            continue;  // the one behind, as ldm_nearest()
        reach = gap;
        found = entry;
    }
    return found;
}

std::optional<float> PointTracer::slope_along(int column, int row, int across, int down, int entry) const {
    const float steepest = steepest_texels * texel_quanta_;
    float least = 2 * steepest;
    std::optional<float> slope;
    for (const int side : {-1, 1}) {
        const auto next =
            nearest(column + side * across, row + side * down, static_cast<float>(entry), steepest);
        if (!next) continue;
        const int straight = 2 * *next - entry;
        const auto second = nearest(column + 2 * side * across, row + 2 * side * down,
                                    static_cast<float>(straight), steepest);
        const float bend = second ? static_cast<float>(std::abs(*second - straight)) : steepest;
        if (!(bend < least)) continue;
        least = bend;
        slope = static_cast<float>(side * (*next - entry));
    }
    return slope;
}

EntryPlane PointTracer::plane_at(int column, int row, int entry) const {
    const auto along_u = slope_along(column, row, 1, 0, entry),
               along_v = slope_along(column, row, 0, 1, entry);
    return {{along_u.value_or(0), along_v.value_or(0)}, along_u && along_v};
}

glm::vec3 PointTracer::normal_of(const EntryPlane& plane, const glm::vec3& direction) const {
    const auto& frame = map_.frame;
    const auto along = frame.direction.w * glm::vec3(frame.direction);
    const auto n = glm::normalize(glm::cross(glm::vec3(frame.step_u) + plane.slope.x * along,
                                             glm::vec3(frame.step_v) + plane.slope.y * along));
    return glm::dot(n, direction) < 0 ? n : -n;
}

glm::vec2 PointTracer::slope_of(const glm::vec3& normal) const {
    const float cosine = glm::dot(normal, glm::vec3(map_.frame.direction));
    const float facing = cosine < 0 ? std::min(cosine, -min_facing) : std::max(cosine, min_facing);
    return glm::vec2(glm::dot(normal, slope_u_), glm::dot(normal, slope_v_)) / -facing;
}

}  // namespace ir::passes::ldm
