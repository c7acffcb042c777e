#pragma once

#include <optional>

#include "renderers/passes/ldm/host/streamed_map.h"

namespace ir::passes::ldm {

/// What a band of a map answers to one point.
struct FirstHit {
    bool is_here;                        ///< false: another band of the map has the answer
    bool is_found;                       ///< false: the way out of the map is open
    float distance = 0;                  ///< in quanta, along ω
    int column = 0, row = 0, entry = 0;  ///< the texel that was queried, and the hit's depth at its centre
};

/// The surface about an entry: depth(texel + δ) = entry + slope·δ.
struct EntryPlane {
    glm::vec2 slope{0};  ///< quanta per texel
    bool is_known = false;
};

/// Queries a band of a map that holds lists for single points, the same questions as
/// shaders/passes/ldm/trace.glsl. What does not change within a map is worked out once.
class PointTracer {
  public:
    PointTracer(const StreamedMap& map, const SelfHitRule& rule);
    /// First hit from x along ω = v (`forward`) or -v; n is geometric, of unit length, and n·ω > 0.
    FirstHit trace(const glm::vec3& position_ws, const glm::vec3& normal_ws, bool forward) const {
        return rule_.tangent_plane ? trace_tangent(position_ws, normal_ws, forward)
                                   : trace_offset(position_ws, normal_ws, forward);
    }

    /// Whether the band has this row of texels, or the map has none such.
    bool knows(int row) const {
        return row < 0 || row >= map_.resolution ||
               (row >= map_.first_row && row < map_.first_row + map_.rows);
    }
    /// As ldm_plane(), ldm_nearest(), ldm_normal() and ldm_slope_of() of entry_plane.glsl. What lies in
    /// another band of the map is not found.
    EntryPlane plane_at(int column, int row, int entry) const;
    std::optional<int> nearest(int column, int row, float depth, float reach) const;
    glm::vec3 normal_of(const EntryPlane& plane, const glm::vec3& direction) const;
    glm::vec2 slope_of(const glm::vec3& normal) const;
    /// Texel coordinates and depth of a point.
    glm::vec3 project(const glm::vec3& position_ws) const;

  private:
    std::optional<float> slope_along(int column, int row, int across, int down, int entry) const;
    FirstHit trace_tangent(const glm::vec3& position_ws, const glm::vec3& normal_ws, bool forward) const;
    FirstHit trace_offset(const glm::vec3& position_ws, const glm::vec3& normal_ws, bool forward) const;
    bool is_outside(int column, int row) const {
        return column < 0 || row < 0 || column >= map_.resolution || row >= map_.resolution;
    }
    /// Of a texel, of values that each entry has.
    std::span<const std::uint16_t> list(int column, int row, const std::vector<std::uint16_t>& values) const;
    /// As LdmSlopeTest of node.glsl.
    struct SlopeTest {
        glm::vec2 place;  ///< of the point, texels from the centre
        float depth, tolerance;
        int key;
        bool forward;
    };
    /// ldm_lies_before() of node.glsl
    bool lies_before(const SlopeTest& test, int depth, unsigned codes) const;
    /// The nearest entry beyond the key along ω that lies before the point by its slopes, too.
    int next_by_slopes(int column, int row, const SlopeTest& test) const;
    /// Where the point is outside of the map the first band answers.
    FirstHit beside() const { return {map_.first_row == 0, false}; }

    const StreamedMap& map_;
    SelfHitRule rule_;
    glm::vec3 slope_u_, slope_v_;  ///< step / metres per quantum
    float texel_size_, texel_quanta_;
};

}  // namespace ir::passes::ldm
