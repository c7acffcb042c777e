#include "renderers/scene/builtin/solids.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/architecture.h"

namespace ir::scene::builtin {
namespace {

constexpr std::array<BoxFace, 6> faces = {BoxFace::pos_x, BoxFace::neg_x, BoxFace::pos_y,
                                          BoxFace::neg_y, BoxFace::pos_z, BoxFace::neg_z};
constexpr int steps[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

/// Where planes across an axis cut the body, ascending.
std::vector<float> cuts(const Carving& c, int axis) {
    std::vector<float> result{c.body.min[axis], c.body.max[axis]};
    for (const auto& hole : c.holes)
        for (const float cut : {hole.min[axis], hole.max[axis]})
            if (cut > c.body.min[axis] && cut < c.body.max[axis]) result.push_back(cut);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

/// The body cut into cells.
struct Cells {
    const Carving& carving;
    std::vector<float> planes[3];

    glm::ivec3 count() const { return glm::ivec3(planes[0].size(), planes[1].size(), planes[2].size()) - 1; }
    Box box(glm::ivec3 cell) const {
        Box result;
        for (int a = 0; a < 3; ++a) {
            result.min[a] = planes[a][cell[a]];
            result.max[a] = planes[a][cell[a] + 1];
        }
        return result;
    }
    bool is_solid(glm::ivec3 cell) const {
        for (int a = 0; a < 3; ++a)
            if (cell[a] < 0 || cell[a] >= count()[a]) return false;
        const Box b = box(cell);
        const glm::vec3 middle = 0.5f * (b.min + b.max);
        return std::none_of(carving.holes.begin(), carving.holes.end(), [&](const Box& hole) {
            return glm::all(glm::greaterThan(middle, hole.min)) && glm::all(glm::lessThan(middle, hole.max));
        });
    }
};

void add_cell(std::span<MeshBuilder> builders, const Cells& cells, glm::ivec3 cell) {
    const Box box = cells.box(cell);
    for (int f = 0; f < 6; ++f) {
        const glm::ivec3 step(steps[f][0], steps[f][1], steps[f][2]);
        if (cells.is_solid(cell + step)) continue;
        const glm::vec3 normal(step);
        const glm::vec3 middle = 0.5f * (box.min + box.max) + 0.5f * normal * (box.max - box.min);
        builders[cells.carving.paint(middle, normal)].box_face(faces[f], box.min, box.max);
    }
}

/// One of the points that a rounded edge is made of: the way to its quadrant or hemisphere, and the angle.
struct Bend {
    float sign_cos, sign_sin, cos, sin;
};

/// Four quadrants around; each starts where the last one ended, a straight side further.
std::vector<Bend> around(int segments) {
    std::vector<Bend> bends;
    for (int q = 0; q < 4; ++q)
        for (int i = 0; i <= segments; ++i) {
            // The first quadrant's numbers turned by right angles: neighbours agree to the last bit.
            const float angle = 0.5f * pi * i / segments;
            const float c = i == segments ? 0 : std::cos(angle), s = i == 0 ? 0 : std::sin(angle);
            const glm::vec2 turned[4] = {{c, s}, {-s, c}, {-c, -s}, {s, -c}};
            const glm::vec2 signs[4] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
            bends.push_back({signs[q].x, signs[q].y, turned[q].x, turned[q].y});
        }
    bends.push_back(bends.front());
    return bends;
}

/// From straight down to straight up in two quarters.
std::vector<Bend> upwards(int segments) {
    std::vector<Bend> bends;
    for (int half = 0; half < 2; ++half)
        for (int i = 0; i <= segments; ++i) {
            const float angle = 0.5f * pi * (half + float(i) / segments) - 0.5f * pi;
            const bool is_pole = (half == 0 && i == 0) || (half == 1 && i == segments);
            bends.push_back({1, half ? 1.0f : -1.0f, is_pole ? 0 : std::cos(angle), std::sin(angle)});
        }
    return bends;
}

}  // namespace

void carve(std::span<MeshBuilder> builders, const Carving& carving) {
    const Cells cells{carving, {cuts(carving, 0), cuts(carving, 1), cuts(carving, 2)}};
    const glm::ivec3 count = cells.count();
    for (int k = 0; k < count.z; ++k)
        for (int j = 0; j < count.y; ++j)
            for (int i = 0; i < count.x; ++i)
                if (cells.is_solid({i, j, k})) add_cell(builders, cells, {i, j, k});
}

void slab(MeshBuilder& b, const Slab& s, int segments) {
    const glm::vec3 centre = 0.5f * (s.min + s.max), half = 0.5f * (s.max - s.min);
    const auto plan = around(segments), rise = upwards(segments);
    const int columns = static_cast<int>(plan.size()) - 1, rows = static_cast<int>(rise.size()) + 1;
    b.grid(columns, rows, [&](float u, float v) {
        const Bend& p = plan[columns - std::lround(u * columns)];  // outwards
        const int row = static_cast<int>(std::lround(v * rows));
        const bool is_middle = row == 0 || row == rows;
        const Bend& r = rise[std::clamp(row, 1, rows - 1) - 1];
        const float reach = s.corner - s.edge + s.edge * r.cos;
        glm::vec3 at(p.sign_cos * (half.x - s.corner) + p.cos * reach,
                     r.sign_sin * (half.y - s.edge) + s.edge * r.sin,
                     p.sign_sin * (half.z - s.corner) + p.sin * reach);
        if (is_middle) at.x = at.z = 0;
        at += centre;
        return Vertex{at, glm::vec3(p.cos * r.cos, r.sin, p.sin * r.cos), {at.x, at.z}};
    });
}

void bar(MeshBuilder& b, glm::vec3 a, glm::vec3 c, float radius, int segments) {
    const glm::vec3 axis = glm::normalize(c - a);
    const glm::vec3 side = std::abs(axis.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    auto frames = arc_frames(a, glm::normalize(glm::cross(side, axis)), axis, 0, -360, segments);
    frames.back() = frames.front();
    const float length = glm::distance(a, c);
    sweep(b, {{0, 0}, {radius, 0}, {radius, length}, {0, length}}, frames);
}

void ball(MeshBuilder& b, glm::vec3 centre, float radius, int segments) {
    const int rows = std::max(2, segments / 2);
    b.grid(segments, rows, [&](float u, float v) {
        const int column = static_cast<int>(std::lround(u * segments)) % segments;
        const float turn = -2 * pi * column / segments, rise = pi * (v - 0.5f);
        const float reach = v == 0 || v == 1 ? 0 : std::cos(rise);
        const glm::vec3 out(reach * std::cos(turn), std::sin(rise), reach * std::sin(turn));
        return Vertex{centre + radius * out, out, {2 * pi * radius * u, pi * radius * v}};
    });
}

void tube(MeshBuilder& b, const Tube& t, int along, int around) {
    // One more row at both ends for the flat ends, of no radius.
    const int ends = t.is_ring ? 0 : 2, rows = along + 2 * ends;
    const auto row_vertex = [&](int row, float turn) {
        const int step = t.is_ring ? row % along : std::clamp(row - ends, 0, along);
        const float at = float(step) / along, h = 1e-3f;
        const glm::vec3 way = glm::normalize(t.curve(at + h) - t.curve(at - h));
        const glm::vec3 out = glm::normalize(glm::cross(t.side, way));
        const bool is_end = !t.is_ring && (row < ends || row > rows - ends);
        const bool is_middle = !t.is_ring && (row == 0 || row == rows);
        const glm::vec3 radial = std::cos(turn) * out + std::sin(turn) * t.side;
        const float flare =
            (t.radius(at + h) - t.radius(at - h)) / glm::distance(t.curve(at + h), t.curve(at - h));
        const glm::vec3 normal = is_end ? (row < ends ? -way : way) : glm::normalize(radial - flare * way);
        return Vertex{t.curve(at) + (is_middle ? 0.0f : t.radius(at)) * radial,
                      normal,
                      {turn * t.radius(at), float(row) / rows}};
    };
    b.grid(around, rows, [&](float u, float v) {
        const int column = static_cast<int>(std::lround(u * around)) % around;
        return row_vertex(static_cast<int>(std::lround(v * rows)), 2 * pi * column / around);
    });
}

void sheet(MeshBuilder& b, int columns, int rows, const std::function<glm::vec3(float, float)>& position,
           float thickness, glm::vec2 uv_scale) {
    const float h = 1e-3f;
    const auto vertex = [&](float u, float v, bool is_upper) {
        const glm::vec3 du = position(u + h, v) - position(u - h, v);
        const glm::vec3 dv = position(u, v + h) - position(u, v - h);
        const glm::vec3 normal = glm::normalize(glm::cross(du, dv));
        const glm::vec3 upper = position(u, v);
        return Vertex{is_upper ? upper : upper - thickness * normal, is_upper ? normal : -normal,
                      glm::vec2(u, v) * uv_scale};
    };
    b.grid(columns, rows, [&](float u, float v) { return vertex(u, v, true); });
    b.grid(columns, rows, [&](float u, float v) { return vertex(1 - u, v, false); });
    // Edges: each runs so that its outside is to the right of the way.
    const auto edge = [&](int count, auto at) {
        b.grid(count, 1, [&](float t, float s) {
            const glm::vec2 uv = at(t), further = at(t + h);
            Vertex result = vertex(uv.x, uv.y, s > 0.5f);
            const glm::vec3 upper = position(uv.x, uv.y), way = position(further.x, further.y) - upper;
            const glm::vec3 up = upper - vertex(uv.x, uv.y, false).position;
            result.normal = glm::normalize(glm::cross(way, up));
            return result;
        });
    };
    edge(columns, [](float t) { return glm::vec2(t, 0); });
    edge(columns, [](float t) { return glm::vec2(1 - t, 1); });
    edge(rows, [](float t) { return glm::vec2(1, t); });
    edge(rows, [](float t) { return glm::vec2(0, 1 - t); });
}

}  // namespace ir::scene::builtin
