#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "renderers/core/transport.h"
#include "renderers/passes/bounce/filter.h"

namespace ir::passes::bounce {

/// A number for each pixel of a tile and its rim; of vectors a plane for each part.
using Plane = std::vector<float>;
using Planes = std::array<Plane, 3>;

inline void set(Planes& planes, std::size_t at, glm::vec3 value) {
    for (int c = 0; c < 3; ++c) planes[static_cast<std::size_t>(c)][at] = value[c];
}

/// What of a reconstruction is the same for all pixels.
struct FilterRules {
    FilterConstants constants;
    bool has_kernels = false;  ///< of widths of their own
    bool ends = true;          ///< sums become what the pixels are; else they are carried on
    bool light = false, ratio = false;
    Transport::Materials materials = Transport::Materials::gltf;
    bool has_balance() const { return light && constants.balance > 0; }
};

/// Pixels of a picture with those around them that the filter reaches, in planes, so that many are worked on
/// at once: what shaders/passes/bounce/filter.glsl looks up and calls by the same names.
struct FilterTile {
    static constexpr int width = 64, height = 8;

    explicit FilterTile(const FilterRules& rules);
    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y + radius) * static_cast<std::size_t>(across) +
               static_cast<std::size_t>(x + radius);
    }

    int radius, across, down;  ///< `across` and `down` with the rim
    Plane exists;              ///< 1; 0: gives nothing and is not reconstructed
    Planes position, blur_normal, geometric_normal, normal;
    Plane narrowing;  ///< only where kernels have widths of their own

    // Only of light: the scatterer, as the viewer sees it, and what directions are chosen by.
    Plane metallic, roughness;
    Planes viewer, diffuse, f0;
    Plane specular, alpha, n_dot_v;
    Planes raised;  ///< only with balance, as the next two
    Plane raised_cosine, specular_probability;

    struct Sample {
        Planes direction;
        Plane density;
        Planes incoming;  ///< without light the first is V
    };
    std::vector<Sample> samples;

    /// Of the pixels without the rim: sums of values and of shares that samples before have left. Then the
    /// same with these samples, or in the first three what the pixels are.
    std::array<std::array<float, width * height>, 4> sums;
};

/// Adds to `sums` of those pixels that exist. As reconstruct.comp.
void reconstruct(const FilterRules& rules, FilterTile& tile);

}  // namespace ir::passes::bounce
