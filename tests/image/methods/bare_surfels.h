#pragma once

#include <string>

#include "renderers/core/value.h"

namespace ir::test {

/// Settings of deep screen space with which nothing but the surfels is approximate: no thinning, no coarser
/// levels, no blur. `radius` in pixels; of a closed surface e^-coverage stays open.
inline Settings bare_surfels(double radius, double coverage) {
    return {{"blur", false},
            {"placement", std::string("random")},
            {"sub_images", std::string("independent")},
            {"discs", std::string("above")},
            {"level0", std::string("discs")},
            {"backs", std::string("lit")},
            {"last_shell", std::string("ends")},
            {"shells", std::string("full-discs")},
            {"thinning", false},
            {"levels", std::int64_t{1}},
            {"influence", std::string("constant")},
            {"surfel_radius", radius},
            {"coverage", coverage}};
}

}  // namespace ir::test
