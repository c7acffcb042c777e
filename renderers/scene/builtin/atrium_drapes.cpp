// Cloth: curtains tied to the columns below, banners over the balustrade, swags in the upper arches.

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/architecture.h"
#include "renderers/scene/builtin/atrium.h"
#include "renderers/scene/builtin/painting.h"

namespace ir::scene::builtin::atrium_parts {
namespace {

using painting::smooth;

/// Width of a curtain that is gathered by a tie, v = 0 at the floor and 1 at the rod.
float curtain_width(float v) {
    const float tie = 0.42f;
    return v > tie ? 0.3f + 0.79f * std::pow((v - tie) / (1 - tie), 1.5f) : 0.3f + 0.2f * smooth(tie, 0, v);
}

/// Half a curtain from the column at `x` (towards `way`), on a rod at `rod_y`.
void add_curtain(MeshBuilder& b, float x, float way, float rod_y, float phase, const Detail& detail) {
    const auto position = [&](float u, float v) {
        const float width = curtain_width(v);
        const float folds = 4, cloth = 1.9f;  // the cloth is longer than the gap: the rest makes folds
        const float depth = std::min(0.065f, 0.08f * std::sqrt(std::max(0.02f, cloth / width - 1)));
        const float wave = std::sin(2 * pi * folds * u + phase + 0.6f * std::sin(3 * v + phase));
        const float belly = 0.05f * std::sin(pi * v) * std::sin(7 * u + phase);
        return glm::vec3(x + way * (0.31f + u * width), 0.03f + (rod_y - 0.01f - 0.03f) * v,
                         -0.02f + depth * wave + belly);
    };
    const glm::vec2 cloth_uv{1, 1};
    const auto mirrored = [&](float u, float v) { return position(1 - u, v); };
    const int columns = detail.segments(36, 8), rows = detail.segments(12, 3);
    if (way > 0)
        b.surface(columns, rows, position, cloth_uv);
    else
        b.surface(columns, rows, mirrored, cloth_uv);
}

/// A banner over the hand rail: s = 0 inside the gallery, 1 at the lower end over the court.
void add_banner(MeshBuilder& b, float middle, float length, float phase, const Detail& detail) {
    const float rail = gallery_floor + 1.0f, inside = 0.55f, over = 0.36f, total = inside + over + length;
    const auto position = [&](float u, float s) {
        const float way = s * total, x = (u - 0.5f) * 1.5f;
        const float hanging = std::max(0.0f, way - inside - over);
        const float open = smooth(0, 1.2f, hanging);
        const float ripple =
            open * (0.07f * std::sin(9 * x + phase + 0.5f * hanging) + 0.03f * std::sin(17 * x - phase));
        const float narrowing = 1 - 0.06f * open;
        float y = rail - hanging, z = -0.17f - 0.47f * smooth(0, 0.9f, hanging);  // clears the cornice below
        if (way < inside) {
            y = rail - (inside - way);
            z = 0.17f + 0.012f * smooth(inside, 0.2f, way) * std::sin(12 * x + phase);
        } else if (way < inside + over) {
            const float t = (way - inside) / over;
            y = rail + 0.035f * std::sin(pi * t);
            z = 0.17f - 0.34f * t;
        }
        return glm::vec3(middle + narrowing * x, y, z + ripple);
    };
    b.surface(detail.segments(24, 6), detail.segments(32, 8), position);
}

/// A cloth that sags between two columns under an upper arch.
void add_swag(MeshBuilder& b, float middle, float phase, const Detail& detail) {
    const auto position = [&](float u, float v) {
        const float x = (u - 0.5f) * (bay - 0.36f), sag = 1 - 4 * (u - 0.5f) * (u - 0.5f);
        const float drop = (1 - v) * (0.16f + 0.62f * sag) + 0.1f * sag;
        const float fold =
            0.05f * (0.25f + sag) * std::sin(6 * pi * (1 - v) + 0.8f * std::sin(3 * x + phase));
        return glm::vec3(middle + x, upper_spring - 0.42f - drop, fold + 0.06f * sag * (1 - v));
    };
    b.surface(detail.segments(28, 8), detail.segments(18, 6), position);
}

bool has_curtain(const Side& side, int i) {
    return side.bays == 8 ? i % 2 == 1 : i != 1;
}
bool has_banner(const Side& side, int i) {
    return side.bays == 8 ? i % 3 == 1 : i == 1;
}

void add_rods(Scene& scene, const Materials& m, const Detail& detail) {
    MeshBuilder b;
    const int segments = detail.segments(8, 5);
    for (const auto& side : sides()) {
        b.transform = side.transform;
        for (int i = 0; i < side.bays; ++i) {
            const float low = i * bay - side.half(), high = low + bay;
            if (has_curtain(side, i)) rod(b, {low, 2.72f, 0}, {high, 2.72f, 0}, 0.022f, segments);
        }
    }
    add_mesh(scene, b.take("curtain rods", m.bronze));
}

}  // namespace

void add_drapes(Scene& scene, const Materials& materials, const Detail& detail) {
    MeshBuilder curtains, cloths[3];
    int number = 0;
    for (const auto& side : sides()) {
        curtains.transform = side.transform;
        for (auto& b : cloths) b.transform = side.transform;
        for (int i = 0; i < side.bays; ++i, ++number) {
            const float low = i * bay - side.half(), high = low + bay, phase = 1.7f * number;
            if (has_curtain(side, i)) {
                add_curtain(curtains, low, 1, 2.72f, phase, detail);
                add_curtain(curtains, high, -1, 2.72f, phase + 2, detail);
            }
            auto& b = cloths[number % 3];
            if (has_banner(side, i)) add_banner(b, low + bay / 2, 2.3f + 0.3f * (i % 2), phase, detail);
            if (has_curtain(side, i) && side.bays == 8) add_swag(b, low + bay / 2, phase, detail);
        }
    }
    add_mesh(scene, curtains.take("curtains", materials.cloth[0]));
    const char* names[3] = {"red drapes", "blue drapes", "green drapes"};
    for (int i = 0; i < 3; ++i) add_mesh(scene, cloths[i].take(names[i], materials.cloth[i]));
    add_rods(scene, materials, detail);
}

}  // namespace ir::scene::builtin::atrium_parts
