#include "renderers/scene/opening_camera.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "renderers/scene/free_space.h"

namespace ir::scene {
namespace {

constexpr const char* camera_name = "default";

/// A moderate wide angle: rooms look roomy, and their corners are not drawn out.
constexpr float room_fov_y = glm::radians(55.0f);
/// Width by height of the picture that is judged; others see a little more or less at its sides.
constexpr float aspect = 1.5f;
/// Of a standing person, m; rooms that are lower are looked at from a little below the middle.
constexpr float eye_height = 1.7f, part_of_low_rooms = 0.45f;
/// A place is in a room if most rays around it end at fronts of surfaces, level ones more than others.
constexpr float min_hits = 0.6f, min_level_hits = 0.6f, min_floor_hits = 0.85f;
/// Cosine from which on a cell shows its front or its back; between them it has both.
constexpr float side = 0.2f;
/// Of a picture into an open room.
constexpr float min_good = 0.93f;
/// Places that are looked at first, evenly over the grid, and those around which others are tried.
constexpr double first_places = 600;
constexpr std::size_t best_places = 5;
/// A panorama's columns and rows: 6° each, up and down to 48°.
constexpr int columns = 60, rows = 16;

/// A unit direction of a panorama. Column 0 and row rows / 2 are -Z.
glm::vec3 direction_of(float column, float row) {
    constexpr float step = 2 * std::numbers::pi_v<float> / columns;
    const float azimuth = (column + 0.5f) * step, elevation = (row + 0.5f - 0.5f * rows) * step;
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
            -std::cos(elevation) * std::cos(azimuth)};
}

/// Well spread over the sphere.  [González10, Fibonacci lattice]
template <std::size_t N>
std::array<glm::vec3, N> sphere_directions() {
    std::array<glm::vec3, N> directions;
    for (std::size_t i = 0; i < N; ++i) {
        const float y = 1 - 2 * (static_cast<float>(i) + 0.5f) / N;
        const float azimuth = static_cast<float>(i) * std::numbers::pi_v<float> * (3 - std::sqrt(5.0f));
        const float r = std::sqrt(1 - y * y);
        directions[i] = {r * std::cos(azimuth), y, r * std::sin(azimuth)};
    }
    return directions;
}

/// The mean way to the next surface in all directions, m; 0 where a place is in no room. Inside of solid
/// things rays end at backs, outdoors and between the legs of things many end nowhere, and a room has a
/// floor.
float room_around(const FreeSpace& space, glm::vec3 eye, float extent) {
    static const auto directions = sphere_directions<96>();
    float distances = 0;
    int hits = 0, level = 0, level_hits = 0, down = 0, floor_hits = 0, fronts = 0, backs = 0;
    for (const auto& direction : directions) {
        const bool is_level = std::abs(direction.y) < 0.4f, is_down = direction.y < -0.6f;
        level += is_level;
        down += is_down;
        const auto hit = space.ray(eye, direction);
        distances += hit ? hit->distance : 0.5f * extent;  // of open roofs and windows
        if (!hit) continue;
        ++hits;
        level_hits += is_level;
        floor_hits += is_down && hit->facing > -side;
        fronts += hit->facing > side;
        backs += hit->facing < -side;
    }
    const auto most = [](int count, int all, float part) {
        return static_cast<float>(count) >= part * static_cast<float>(all);
    };
    const bool is_room = most(hits, static_cast<int>(directions.size()), min_hits) &&
                         most(level_hits, level, min_level_hits) && most(floor_hits, down, min_floor_hits) &&
                         fronts >= 2 * backs;
    return is_room ? distances / static_cast<float>(directions.size()) : 0;
}

struct Sight {
    glm::vec3 eye{0};
    int column = 0, pitch = 0;  ///< of the middle: steps of a panorama to the right, and up
    float score = 0;
    float distance = 1;  ///< to what is seen, m, on average
    float good = 0;      ///< part of the picture that shows the room

    glm::vec3 forward() const {
        return direction_of(static_cast<float>(column) - 0.5f,
                            0.5f * rows - 0.5f + static_cast<float>(pitch));
    }
};

/// What is seen from a place, all around.
class Panorama {
  public:
    /// `extent`: of the scene, m.
    Panorama(const FreeSpace& space, glm::vec3 eye, float extent) : eye_(eye), extent_(extent) {
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column) {
                const auto hit =
                    space.ray(eye, direction_of(static_cast<float>(column), static_cast<float>(row)));
                // Backs of walls are no sight.
                if (hit && hit->facing > -side)
                    at(row, column) = {hit->distance, std::min(hit->detail, max_detail), hit->material};
            }
    }

    /// The best direction.
    Sight best() const {
        Sight best;
        for (int column = 0; column < columns; ++column)
            for (int pitch = -2; pitch <= 1; ++pitch) {
                const Sight sight = judge(column, pitch);
                if (sight.score > best.score) best = sight;
            }
        return best;
    }

    Sight judge(int column, int pitch) const {
        constexpr float step = 2 * std::numbers::pi_v<float> / columns;
        const int half_height = static_cast<int>(std::lround(0.5f * room_fov_y / step));
        const float half_width_angle = std::atan(aspect * std::tan(0.5f * room_fov_y));
        const int half_width = static_cast<int>(std::lround(half_width_angle / step));
        float interest = 0, distances = 0;
        int rays = 0, seen = 0, close = 0;
        std::uint64_t materials = 0;  // by number modulo 64: who has more than that has enough
        for (int y = rows / 2 + pitch - half_height; y < rows / 2 + pitch + half_height; ++y)
            for (int x = column - half_width; x < column + half_width; ++x) {
                const auto [distance, detail, material] =
                    at(std::clamp(y, 0, rows - 1), (x + columns) % columns);
                ++rays;
                seen += distance > 0;
                close += distance > 0 && distance < close_part * extent_;
                interest += detail * std::min(distance, far_part * extent_);
                distances += distance;
                if (distance > 0) materials |= std::uint64_t{1} << (material % 64);
            }
        const float all = static_cast<float>(rays), open = 1 - static_cast<float>(close) / all;
        Sight sight{.eye = eye_, .column = column, .pitch = pitch};
        sight.score = interest * open * open * static_cast<float>(seen) / all;
        // A nave shows more than a corridor of its size.
        sight.score *= static_cast<float>(std::popcount(materials));
        if (pitch != 0) sight.score *= 0.93f;  // upright lines stay upright
        sight.score *= std::sqrt(std::min(width_at(column) / extent_, wide_part));
        sight.distance = distances / static_cast<float>(std::max(1, seen));
        sight.good = static_cast<float>(seen - close) / all;
        return sight;
    }

  private:
    struct Seen {
        float distance = 0;  ///< m; 0: nothing
        float detail = 0;
        int material = 0;
    };
    Seen& at(int row, int column) {
        return seen_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    }
    const Seen& at(int row, int column) const {
        return seen_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    }

    /// Room to the nearer side of the eye, across the view, m.
    float width_at(int column) const {
        float sides[2] = {extent_, extent_};
        for (int turn = columns / 5; turn <= columns / 3; ++turn)
            for (int i = 0; i < 2; ++i) {
                const float distance =
                    at(rows / 2, (column + (i == 0 ? turn : columns - turn)) % columns).distance;
                if (distance > 0) sides[i] = std::min(sides[i], distance);
            }
        return std::min(sides[0], sides[1]);
    }

    /// Of the scene's extent: what is nearer hides more than it shows; what is farther counts no more; wider
    /// than this the place is no better.
    static constexpr float close_part = 0.06f, far_part = 0.7f, wide_part = 0.3f;
    /// Things count more than plain walls, but a hedge no more than a chair.
    static constexpr float max_detail = 4;
    glm::vec3 eye_;
    float extent_;
    std::array<std::array<Seen, columns>, rows> seen_{};
};

/// A room that is open behind the eye, as a stage is, is looked into from before it: as far back as nothing
/// but the room is seen.
Sight stepped_back(const FreeSpace& space, const Sight& from, float extent) {
    const auto backward = -from.forward();
    if (from.good < min_good || space.ray(from.eye, backward)) return from;
    Sight best = from;
    for (float back = space.cell_size(); back < extent; back += space.cell_size()) {
        const Panorama panorama(space, from.eye + back * backward, extent);
        const auto sight = panorama.judge(from.column, from.pitch);
        if (sight.good < min_good) break;
        best = sight;
    }
    return best;
}

/// How far a place is from the height of a person's eyes, or in low rooms from the middle: 1 … 0. The floor
/// is the lowest surface near: nobody stands on tables.
float height_factor(const FreeSpace& space, glm::vec3 eye) {
    static const auto directions = sphere_directions<48>();
    float below = 0;
    for (const auto& direction : directions) {
        if (direction.y > -0.6f) continue;
        const auto hit = space.ray(eye, direction);
        below = std::max(below, hit ? -direction.y * hit->distance : eye.y - space.bounds().min.y);
    }
    const auto up = space.ray(eye, {0, 1, 0});
    const float above = up ? up->distance : std::max(0.0f, space.bounds().max.y - eye.y);
    const float wanted = std::min(eye_height, part_of_low_rooms * (below + above));
    const float octaves = std::log2(std::max(below, 1e-6f * wanted) / std::max(wanted, 1e-6f));
    return std::exp(-0.5f * octaves * octaves / (0.8f * 0.8f));
}

/// Looks for the place in a room from which most is seen.
class Search {
  public:
    explicit Search(const FreeSpace& space) : space_(space) {
        const auto extent = space.bounds().max - space.bounds().min;
        extent_ = std::max({extent.x, extent.y, extent.z});
        int widest = 0;
        for_each_cell(1, [&](glm::ivec3 cell) { widest = std::max(widest, space.clearance(cell)); });
        min_clearance_ = std::min(std::clamp(widest / 4, 2, 3), widest);
    }

    /// Its score is 0 where there is no room.
    Sight run() {
        double free = 0;
        for_each_cell(1, [&](glm::ivec3 cell) { free += space_.clearance(cell) >= min_clearance_; });
        int stride = std::max(1, static_cast<int>(std::cbrt(free / first_places) + 0.5));
        std::vector<Found> found;
        for_each_cell(stride, [&](glm::ivec3 cell) { add(found, cell); });
        if (found.empty()) return {};
        while (true) {
            std::sort(found.begin(), found.end(),
                      [](const Found& a, const Found& b) { return a.sight.score > b.sight.score; });
            if (found.size() > best_places) found.resize(best_places);
            if (stride == 1) return stepped_back(space_, found.front().sight, extent_);
            stride = (stride + 1) / 2;
            for (std::size_t i = 0, count = found.size(); i < count; ++i)
                for (int side = 0; side < 6; ++side) {
                    auto cell = found[i].cell;
                    cell[side / 2] += side % 2 == 0 ? -stride : stride;
                    add(found, cell);
                }
        }
    }

  private:
    struct Found {
        glm::ivec3 cell;
        Sight sight;
    };

    /// Those outermost lie outside.
    template <class Visit>
    void for_each_cell(int stride, Visit&& visit) const {
        const auto size = space_.size();
        for (int z = 1; z + 1 < size.z; z += stride)
            for (int y = 1; y + 1 < size.y; y += stride)
                for (int x = 1; x + 1 < size.x; x += stride) visit(glm::ivec3(x, y, z));
    }

    void add(std::vector<Found>& found, glm::ivec3 cell) const {
        const auto eye = space_.centre_of(cell);
        if (space_.clearance(cell) < min_clearance_) return;
        const float room = room_around(space_, eye, extent_);
        if (room == 0) return;
        Found place{cell, Panorama(space_, eye, extent_).best()};
        place.sight.score *= height_factor(space_, eye) * room;
        found.push_back(place);
    }

    const FreeSpace& space_;
    float extent_ = 1;
    int min_clearance_ = 1;
};

}  // namespace

Camera framing_camera(const Bounds& bounds) {
    Camera camera;
    camera.name = camera_name;
    camera.is_made_up = true;
    camera.target = bounds.centre();
    const bool is_usable = bounds.radius() > 0 && std::isfinite(bounds.radius());
    const auto half = is_usable ? 0.5f * (bounds.max - bounds.min) : glm::vec3(0.5f);
    const auto backward = glm::normalize(glm::vec3(0.6f, 0.4f, 1.0f));
    const auto right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), backward));
    const auto up = glm::cross(backward, right);
    // All corners of the bounds, also in a square picture, with a little air.
    const float tangent = std::tan(0.5f * camera.fov_y) / 1.08f;
    float distance = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 corner((i & 1) ? half.x : -half.x, (i & 2) ? half.y : -half.y,
                               (i & 4) ? half.z : -half.z);
        const float aside = std::max(std::abs(glm::dot(corner, right)), std::abs(glm::dot(corner, up)));
        distance = std::max(distance, glm::dot(corner, backward) + aside / tangent);
    }
    camera.eye = camera.target + distance * backward;
    return camera;
}

Camera opening_camera(const Scene& scene) {
    const FreeSpace space(scene);
    auto camera = framing_camera(space.bounds());
    if (space.empty()) return camera;
    const Sight best = Search(space).run();
    if (best.score == 0) return camera;
    camera.fov_y = room_fov_y;
    camera.eye = best.eye;
    camera.target = best.eye + best.distance * best.forward();
    return camera;
}

}  // namespace ir::scene
