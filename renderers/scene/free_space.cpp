#include "renderers/scene/free_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "renderers/scene/placed_mesh.h"

namespace ir::scene {
namespace {

constexpr int max_cells = 64;          ///< along the longest side
constexpr double max_samples = 3e6;    ///< on all surfaces: they take about 50 ms
constexpr float samples_per_cell = 2;  ///< along a line, so that no surface has holes

/// The longest edge of a triangle, and its height above that.
struct Extent {
    float base, height;
};
Extent extent_of(const glm::vec3 (&p)[3]) {
    const float base =
        std::max({glm::length(p[1] - p[0]), glm::length(p[2] - p[1]), glm::length(p[0] - p[2])});
    const float area_twice = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    return {base, base > 0 ? area_twice / base : 0};
}

bool is_finite(const glm::vec3 (&p)[3]) {
    return std::all_of(std::begin(p), std::end(p), [](glm::vec3 v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    });
}

/// Calls `visit(corners, normal, material)` with each triangle in world space at time 0; the normal is the
/// sum of its vertices', which tell the front also where the winding does not.
template <class Visit>
void for_each_triangle(const Scene& scene, Visit&& visit) {
    const auto pose = pose_at(scene, 0);
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        for (const int m : scene.nodes[n].meshes) {
            const auto& mesh = scene.meshes[static_cast<std::size_t>(m)];
            const PlacedMesh placed(scene, pose, static_cast<int>(n), m);
            for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
                glm::vec3 corners[3], normal(0);
                for (std::size_t c = 0; c < 3; ++c) {
                    corners[c] = placed.position(mesh.indices[i + c]);
                    normal += placed.normal(mesh.indices[i + c]);
                }
                if (is_finite(corners)) visit(corners, normal, mesh.material);
            }
        }
    }
}

}  // namespace

FreeSpace::FreeSpace(const Scene& scene) : bounds_(bounds_of(scene, 0)) {
    const auto extent = bounds_.max - bounds_.min;
    const float longest = std::max({extent.x, extent.y, extent.z});
    if (!(longest > 0) || !std::isfinite(longest)) return;
    cell_size_ = longest / max_cells;
    double along = 0, over = 0, count = 0;  // samples at cells of this size
    for_each_triangle(scene, [&](const auto& corners, glm::vec3, int) {
        const auto [base, height] = extent_of(corners);
        const double per_metre = samples_per_cell / static_cast<double>(cell_size_);
        along += base * per_metre;
        over += 0.5 * base * height * per_metre * per_metre;
        count += 1;
    });
    while (cell_size_ < longest / 8 && count + along + over > max_samples) {
        cell_size_ *= 1.25f;
        along /= 1.25;
        over /= 1.25 * 1.25;
        if (count > max_samples) break;  // each triangle is looked at once in any case
    }
    origin_ = bounds_.min - glm::vec3(cell_size_);
    size_ = glm::ivec3(extent / cell_size_) + 3;
    cells_.resize(static_cast<std::size_t>(size_.x) * size_.y * size_.z);
    for_each_triangle(scene, [&](const auto& corners, glm::vec3 normal, int material) {
        add_triangle(corners, normal, material);
    });
    find_clearances();
}

std::size_t FreeSpace::index(glm::ivec3 cell) const {
    return (static_cast<std::size_t>(cell.z) * size_.y + cell.y) * size_.x + cell.x;
}

bool FreeSpace::contains(glm::ivec3 cell) const {
    return cell.x >= 0 && cell.y >= 0 && cell.z >= 0 && cell.x < size_.x && cell.y < size_.y &&
           cell.z < size_.z;
}

glm::vec3 FreeSpace::centre_of(glm::ivec3 cell) const {
    return origin_ + (glm::vec3(cell) + 0.5f) * cell_size_;
}

int FreeSpace::clearance(glm::ivec3 cell) const {
    return contains(cell) ? clearances_[index(cell)] : std::numeric_limits<int>::max();
}

/// In rows along the longest edge, so that slivers take few samples.
void FreeSpace::add_triangle(const glm::vec3 (&corners)[3], glm::vec3 normal, int material) {
    auto face = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const float area = 0.5f * glm::length(face);
    if (!std::isfinite(area)) return;  // beyond the range of a float; rows could not be counted
    if (area > 0) face /= 2 * area;
    if (glm::dot(face, normal) < 0) face = -face;
    int first = 0;  // of the longest edge
    float longest = 0;
    for (int e = 0; e < 3; ++e) {
        const float length = glm::length(corners[(e + 1) % 3] - corners[e]);
        if (length > longest) first = e, longest = length;
    }
    const auto a = corners[first], b = corners[(first + 1) % 3], apex = corners[(first + 2) % 3];
    const float spacing = cell_size_ / samples_per_cell;
    const auto parts = [&](float length) {
        constexpr float max_parts = 1 << 12;  // more than any grid has
        return static_cast<int>(std::clamp(std::ceil(length / spacing), 1.0f, max_parts));
    };
    const int rows = parts(longest > 0 ? 2 * area / longest : 0);
    for (int row = 0; row < rows; ++row) {
        const float up = (static_cast<float>(row) + 0.5f) / static_cast<float>(rows);
        const auto left = glm::mix(a, apex, up), right = glm::mix(b, apex, up);
        const int columns = parts(glm::length(right - left));
        // of the triangle's area, by the length of its row
        const float part = area * 2 * (1 - up) / static_cast<float>(rows * columns);
        for (int column = 0; column < columns; ++column) {
            const float across = (static_cast<float>(column) + 0.5f) / static_cast<float>(columns);
            const auto place = (glm::mix(left, right, across) - origin_) / cell_size_;
            auto& cell = cells_[index(glm::ivec3(glm::clamp(place, glm::vec3(0), glm::vec3(size_ - 1))))];
            cell.normal += part * face;
            cell.material = material;
            cell.area += std::max(part, 1e-12f);
        }
    }
}

/// By the largest of the three differences of coordinates, in two sweeps [Rosenfeld66].
void FreeSpace::find_clearances() {
    clearances_.assign(cells_.size(), 255);
    for (std::size_t i = 0; i < cells_.size(); ++i)
        if (cells_[i].area > 0) clearances_[i] = 0;
    const auto sweep = [&](int direction) {
        const auto count = static_cast<int>(cells_.size());
        for (int i = 0; i < count; ++i) {
            const int at = direction > 0 ? i : count - 1 - i;
            const glm::ivec3 cell(at % size_.x, at / size_.x % size_.y, at / size_.x / size_.y);
            auto& nearest = clearances_[static_cast<std::size_t>(at)];
            for (int n = 0; n < 13 && nearest > 1; ++n) {  // the neighbours that the sweep has visited
                const auto neighbour = cell - direction * (1 - glm::ivec3(n % 3, n / 3 % 3, n / 9));
                if (contains(neighbour) && clearances_[index(neighbour)] < nearest)
                    nearest = static_cast<std::uint8_t>(clearances_[index(neighbour)] + 1);
            }
        }
    };
    sweep(1);
    sweep(-1);
}

/// From cell to cell [Amanatides87].
std::optional<FreeSpace::Hit> FreeSpace::ray(glm::vec3 origin_ws, glm::vec3 direction_ws) const {
    const auto start = (origin_ws - origin_) / cell_size_;
    glm::ivec3 cell(glm::floor(start)), step;
    glm::vec3 next, delta;  // distances in cells: to the next border, between borders
    float entered = 0;
    for (int c = 0; c < 3; ++c) {
        const float d = direction_ws[c];
        step[c] = d > 0 ? 1 : -1;
        delta[c] = d != 0 ? 1 / std::abs(d) : std::numeric_limits<float>::infinity();
        const float border = static_cast<float>(cell[c] + (d > 0 ? 1 : 0));
        next[c] = d != 0 ? (border - start[c]) / d : std::numeric_limits<float>::infinity();
    }
    while (true) {
        const int c = next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
        if (!(next[c] < std::numeric_limits<float>::infinity())) return {};
        if (contains(cell)) {
            const auto at = index(cell);
            if (clearances_[at] == 0)
                return Hit{0.5f * (entered + next[c]) * cell_size_,
                           -glm::dot(cells_[at].normal, direction_ws) / cells_[at].area,
                           cells_[at].area / (cell_size_ * cell_size_), cells_[at].material};
        } else if ((step[c] > 0 ? cell[c] >= size_[c] : cell[c] < 0)) {
            return {};
        }
        entered = next[c];
        next[c] += delta[c];
        cell[c] += step[c];
    }
}

}  // namespace ir::scene
