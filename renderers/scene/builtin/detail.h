#pragma once

#include <algorithm>
#include <cmath>

namespace ir::scene::builtin {

/// A level of detail, which scales the triangles of round things.
struct Detail {
    float scale = 1;
    float plain = 0.25f;  ///< below this scale ornaments are left out, and edges are sharp
    bool is_plain() const { return scale < plain; }
    int segments(int base, int min) const {
        return std::max(min, static_cast<int>(std::lround(base * std::sqrt(scale))));
    }
    int count(int base) const { return std::max(1, static_cast<int>(std::lround(base * scale))); }
    float bevel(float width) const { return is_plain() ? 0 : width; }
};

}  // namespace ir::scene::builtin
