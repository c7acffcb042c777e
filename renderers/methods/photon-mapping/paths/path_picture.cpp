#include "renderers/methods/photon-mapping/paths/path_picture.h"

#include <algorithm>
#include <cmath>

#include "renderers/passes/gbuffer/pixel_rays.h"
#include "shaders/methods/photon-mapping/records.glsl.h"

namespace ir::methods::photon_mapping {
namespace {

/// Rows of a picture for each pixel of a line's width, and how much wider the chosen path is.
constexpr int rows_of_a_line = 360, chosen_lines = 3;
/// Pixels of lines and gaps behind what is seen.
constexpr int dash = 3;
constexpr std::uint32_t leg_colours = 8;  ///< of overlay.frag

/// Of a leg in the picture: x and y, and 1 / depth, or the depth of a parallel view, which are linear there.
struct Screen {
    glm::mat4 pixel_from_world;
    glm::vec4 depth_row;  ///< of view space, turned to be positive before the camera
    bool perspective;

    explicit Screen(const scene::View& view)
        : pixel_from_world(passes::pixel_from_world(view)),
          depth_row(-glm::transpose(view.view_from_world)[2]),
          perspective(view.clip_from_view[3][3] == 0) {}
    float depth(glm::vec3 place_ws) const { return glm::dot(depth_row, glm::vec4(place_ws, 1)); }
    glm::vec3 at(glm::vec3 place_ws) const {
        const auto pixel = pixel_from_world * glm::vec4(place_ws, 1);
        const float z = depth(place_ws);
        return {pixel.x / pixel.w, pixel.y / pixel.w, perspective ? 1 / z : z};
    }
    float depth_of(glm::vec3 screen) const { return perspective ? 1 / screen.z : screen.z; }
};

/// The part of a leg before the near plane.
bool clip_by_depth(const Screen& screen, float near, glm::vec3& start, glm::vec3& end) {
    const float a = screen.depth(start) - near, b = screen.depth(end) - near;
    if (a <= 0 && b <= 0) return false;
    const auto cut = start + a / (a - b) * (end - start);
    if (a < 0) start = cut;
    if (b < 0) end = cut;
    return true;
}

/// The part of a line within the picture.
bool clip_by_sides(glm::vec2 size, glm::vec3& start, glm::vec3& end) {
    const auto step = end - start;
    float from = 0, to = 1;
    for (int axis = 0; axis < 2; ++axis)
        for (const float side : {0.0f, size[axis]}) {
            const float along = side == 0 ? -step[axis] : step[axis];
            const float room = side == 0 ? start[axis] : side - start[axis];
            if (along == 0 && room < 0) return false;
            if (along < 0) from = std::max(from, room / along);
            if (along > 0) to = std::min(to, room / along);
        }
    if (from > to) return false;
    end = start + to * step;
    start += from * step;
    return true;
}

struct Picture {
    const Screen& screen;
    int width, height;
    std::span<const glm::vec4> surfaces;
    std::span<std::uint32_t> marks;

    bool is_hidden(glm::ivec2 pixel, float depth) const {
        const auto surface = surfaces[static_cast<std::size_t>(pixel.y * width + pixel.x)];
        return surface.w != 0 && depth > (1 + depth_tolerance) * screen.depth(glm::vec3(surface));
    }
    void mark(glm::ivec2 pixel, int size, std::uint32_t value) const {
        const auto corner = pixel - (size - 1) / 2;
        for (int y = std::max(0, corner.y); y < std::min(height, corner.y + size); ++y)
            for (int x = std::max(0, corner.x); x < std::min(width, corner.x + size); ++x)
                marks[static_cast<std::size_t>(y * width + x)] = value;
    }
    void line(glm::vec3 start, glm::vec3 end, int size, std::uint32_t value) const {
        const auto way = end - start;
        const int steps =
            std::max(1, static_cast<int>(std::ceil(std::max(std::abs(way.x), std::abs(way.y)))));
        for (int i = 0; i <= steps; ++i) {
            const auto place = start + static_cast<float>(i) / static_cast<float>(steps) * way;
            const auto pixel =
                glm::min(glm::ivec2(glm::floor(glm::vec2(place))), glm::ivec2(width, height) - 1);
            const bool is_gap = i / (dash * size) % 2 != 0;
            if (is_gap && is_hidden(glm::max(pixel, 0), screen.depth_of(place))) continue;
            mark(glm::max(pixel, 0), size, value);
        }
    }
};

}  // namespace

void draw_legs(std::span<const PathLeg> legs, const scene::View& view, std::span<const glm::vec4> surfaces,
               std::span<std::uint32_t> marks) {
    const Screen screen(view);
    const Picture picture{screen, view.width, view.height, surfaces, marks};
    const int width = std::max(1, view.height / rows_of_a_line);
    for (const bool chosen : {false, true})
        for (auto leg = legs.rbegin(); leg != legs.rend(); ++leg) {
            if ((leg->chosen != 0) != chosen) continue;
            glm::vec3 start(leg->start[0], leg->start[1], leg->start[2]);
            glm::vec3 end(leg->end[0], leg->end[1], leg->end[2]);
            if (!clip_by_depth(screen, view.near_plane, start, end)) continue;
            start = screen.at(start), end = screen.at(end);
            if (!clip_by_sides({view.width, view.height}, start, end)) continue;
            picture.line(start, end, chosen ? chosen_lines * width : width, leg->leg % leg_colours + 1);
        }
}

}  // namespace ir::methods::photon_mapping
