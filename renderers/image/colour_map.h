#pragma once

#include <array>
#include <string>
#include <vector>

namespace ir {

/// 256 sRGB-encoded entries.
using ColourMap = std::vector<std::array<unsigned char, 3>>;

/// "grey", "viridis", "magma", "turbo", "coolwarm" (diverging). Throws UsageError that lists the known names.
const ColourMap& colour_map(const std::string& name);
const std::vector<std::string>& colour_map_names();

/// sRGB transfer function of a linear value in [0,1] and its inverse [IEC 61966-2-1].
float srgb_from_linear(float linear);
float linear_from_srgb(float encoded);

}  // namespace ir
