#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderers/core/category.h"

namespace ir {

/// 256 sRGB-encoded entries.
using ColourMap = std::vector<std::array<unsigned char, 3>>;

/// "grey", "viridis", "magma", "turbo", "coolwarm" (diverging). Throws UsageError that lists the known names.
const ColourMap& colour_map(const std::string& name);
const std::vector<std::string>& colour_map_names();

/// Of numbers in low … high, which are whole numbers with names: a step for each. Numbers without a name are
/// nearly black.
inline constexpr Tint colour_without_name{20, 20, 20};
struct StepMap {
    ColourMap colours;
    double low = 0, high = 1;
};
StepMap step_map(const std::vector<Category>& categories);

/// sRGB transfer function of a linear value in [0,1] and its inverse [IEC 61966-2-1].
float srgb_from_linear(float linear);
float linear_from_srgb(float encoded);
glm::vec3 linear_from_srgb(const Tint& tint);

}  // namespace ir
