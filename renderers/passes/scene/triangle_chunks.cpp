#include "renderers/passes/scene/triangle_chunks.h"

#include <algorithm>
#include <array>

namespace ir::passes {
namespace {

/// Whether all of the box lies on the negative side of the plane.
bool is_behind(const glm::vec4& plane, const scene::Bounds& box) {
    const glm::vec3 normal(plane),
        farthest = glm::mix(box.min, box.max, glm::greaterThan(normal, glm::vec3(0)));
    return glm::dot(normal, farthest) + plane.w < 0;
}

}  // namespace

TriangleChunks::TriangleChunks(const scene::World& world) {
    const auto triangles = static_cast<std::uint32_t>(world.triangles());
    bounds_.resize((triangles + chunk - 1) / chunk);
    for (std::uint32_t corner = 0; corner < 3 * triangles; ++corner) {
        auto& box = bounds_[corner / 3 / chunk];
        const auto& position = world.positions[world.indices[corner]];
        box.min = corner % (3 * chunk) == 0 ? position : glm::min(box.min, position);
        box.max = corner % (3 * chunk) == 0 ? position : glm::max(box.max, position);
    }
}

std::vector<TriangleRun> TriangleChunks::seen(const glm::mat4& clip_from_world, TriangleRun range) const {
    const auto rows = glm::transpose(clip_from_world);
    const std::array planes{rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1],
                            rows[3]};
    std::vector<TriangleRun> runs;
    const auto end = range.first + range.count;
    for (auto first = range.first; first < end;) {
        const auto next = std::min(end, (first / chunk + 1) * chunk);
        const auto& box = bounds_[first / chunk];
        const bool is_beside = std::any_of(planes.begin(), planes.end(),
                                           [&](const auto& plane) { return is_behind(plane, box); });
        if (!is_beside) {
            if (!runs.empty() && runs.back().first + runs.back().count == first)
                runs.back().count += next - first;
            else
                runs.push_back({first, next - first});
        }
        first = next;
    }
    return runs;
}

}  // namespace ir::passes
