#include "renderers/scene/builtin/column.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/architecture.h"

namespace ir::scene::builtin {
namespace {

// Heights in units of the shaft's radius.
constexpr float plinth_height = 0.35f, base_height = 1.06f, capital_height = 1.9f, abacus_height = 0.3f;
constexpr float neck = 0.84f;  ///< radius of the shaft's top

void add_base(MeshBuilder& b, glm::vec3 foot, float r, int segments) {
    const float half = 1.38f * r;
    // Two centimetres deep in the floor, so that nothing lies in the floor's plane.
    b.box(foot - glm::vec3(half, 0.02f, half), foot + glm::vec3(half, plinth_height * r, half));
    const int bends = std::max(3, segments / 5);
    Profile p;
    add_arc(p, {1.12f, 0.2f}, 0.2f, -80, 90, bends);
    p.push_back({1.1f, 0.45f});
    add_arc(p, {1.13f, 0.58f}, 0.13f, 250, 110, std::max(2, bends / 2));
    add_arc(p, {1.03f, 0.84f}, 0.12f, -90, 90, bends);
    p.push_back({1.03f, 1.0f});
    p.push_back({1.0f, base_height});
    for (auto& q : p) q *= r;
    lathe(b, foot + glm::vec3(0, plinth_height * r, 0), p, segments);
}

void add_shaft(MeshBuilder& b, const Column& c, float bottom, float top, int segments) {
    const int around = c.flutes ? c.flutes * std::max(3, segments / 6) : segments;
    const int rows = std::max(2, segments / 3);
    const auto position = [&](float u, float v) {
        const float angle = -2 * pi * u;
        const float swelling = 1 - (1 - neck) * std::pow(std::max(v, 0.0f), 1.7f);
        float radius = c.radius * swelling;
        if (c.flutes) {
            const float fade = std::clamp(8 * std::min(v, 1 - v), 0.0f, 1.0f);
            radius *= 1 - 0.07f * fade * std::abs(std::sin(0.5f * c.flutes * angle));
        }
        return c.foot +
               glm::vec3(radius * std::cos(angle), bottom + (top - bottom) * v, radius * std::sin(angle));
    };
    b.surface(around, rows, position, {2 * pi * c.radius, top - bottom});
}

float bell_radius(float v) {
    return neck + 0.36f * v * v * v;
}

/// One leaf that rises along the bell and curls over at its tip.
void add_leaf(MeshBuilder& b, const Column& c, float bottom, float angle, float height, float width,
              int segments) {
    const auto position = [&](float u, float v) {
        const float curl = std::max(0.0f, v - 0.55f) / 0.45f;
        const float across = (u - 0.5f) * width * std::sqrt(std::max(0.05f, 1 - v * v));
        const float ruffle = 0.04f * v * (1 + std::cos(4 * pi * (u - 0.5f)));
        const float up = height * (v - 0.28f * curl * curl * curl);
        const float out =
            bell_radius(up / capital_height) + 0.09f + 0.32f * curl * curl + ruffle - 0.2f * across * across;
        const float turn = angle + across / out;
        return c.foot + glm::vec3(0, bottom, 0) +
               c.radius * glm::vec3(out * std::cos(turn), up, -out * std::sin(turn));
    };
    b.surface(std::max(2, segments / 5), std::max(3, segments / 3), position, {0.1f, 0.2f});
}

void add_capital(MeshBuilder& b, const Column& c, float bottom, int segments) {
    const float r = c.radius, bell = capital_height - abacus_height;
    Profile p;
    add_arc(p, {neck - 0.02f, 0.0f}, 0.09f, -90, 90, std::max(3, segments / 6));
    const int rows = std::max(3, segments / 4);
    for (int i = 1; i <= rows; ++i)
        p.push_back({bell_radius(bell / capital_height * i / rows), 0.09f + (bell - 0.2f) * i / rows});
    add_arc(p, {1.1f, bell - 0.06f}, 0.06f, -60, 90, 3);
    for (auto& q : p) q *= r;
    lathe(b, c.foot + glm::vec3(0, bottom, 0), p, segments);
    for (int i = 0; i < 8 && segments > 8; ++i) {
        add_leaf(b, c, bottom + 0.1f * r, 2 * pi * i / 8, 0.85f, 0.62f, segments);
        add_leaf(b, c, bottom + 0.1f * r, 2 * pi * (i + 0.5f) / 8, 1.4f, 0.55f, segments);
    }
    const float half = plinth_half(c), y = c.height - abacus_height * r;
    b.box(c.foot + glm::vec3(-0.92f * half, y, -0.92f * half),
          c.foot + glm::vec3(0.92f * half, y + 0.12f * r, 0.92f * half));
    // One centimetre deep in what it carries.
    b.box(c.foot + glm::vec3(-half, y + 0.12f * r, -half), c.foot + glm::vec3(half, c.height + 0.01f, half));
}

}  // namespace

float plinth_half(const Column& column) {
    return 1.38f * column.radius;
}

void column(MeshBuilder& b, const Column& c, int segments) {
    const float bottom = (plinth_height + base_height) * c.radius;
    const float top = c.height - capital_height * c.radius;
    add_base(b, c.foot, c.radius, segments);
    add_shaft(b, c, bottom, top, segments);
    add_capital(b, c, top, segments);
}

void baluster(MeshBuilder& b, glm::vec3 foot, float height, int segments, int rows) {
    const float w = 0.065f;
    b.box(foot - glm::vec3(w, 0.01f, w), foot + glm::vec3(w, 0.08f * height, w));
    b.box(foot + glm::vec3(-w, 0.92f * height, -w), foot + glm::vec3(w, height + 0.01f, w));
    Profile p;
    for (int i = 0; i <= rows; ++i) {
        const float t = float(i) / rows;
        const float belly = 0.05f * std::exp(-28 * (t - 0.3f) * (t - 0.3f));
        const float rings = 0.022f * std::exp(-900 * (t - 0.82f) * (t - 0.82f)) +
                            0.03f * std::exp(-500 * t * t) + 0.03f * std::exp(-500 * (t - 1) * (t - 1));
        p.push_back({0.026f + belly + rings, height * (0.08f + 0.84f * t)});
    }
    lathe(b, foot, p, segments);
}

}  // namespace ir::scene::builtin
