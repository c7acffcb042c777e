#pragma once

#include <cstddef>
#include <vector>

#include "renderers/passes/a_trous/a_trous.h"

namespace ir::passes::a_trous {

/// What a pass of the filter reads, in planes of floats. Rows are padded on both sides, with pixels that show
/// nothing, as far as its neighbours reach.
struct FilterPlanes {
    static constexpr int channels = 6;  ///< value, then direction; with a guide the value alone
    static constexpr int vector = 16;   ///< most floats that are read at once
    int width = 0, height = 0, pad = 0, row = 0;
    std::vector<float> normal[3], depth;  ///< depth: infinite where nothing is
    std::vector<float> value[channels];

    /// `used`: of the channels.
    void resize(int w, int h, int reach, int used);
    std::size_t place(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(row) +
               static_cast<std::size_t>(pad + x);
    }
};

/// Constants of a pass, as those of shaders/passes/a_trous/a_trous.comp.
struct FilterRules {
    Edges edges;
    float kernel[3];
    float detail_clip, sigma_value;
    bool bounds_dark_details;
    int stride;
};

/// A row of a pass's results, channel by channel.
struct FilteredRow {
    std::vector<float> next[FilterPlanes::channels];     ///< S_{i+1}
    std::vector<float> clipped[FilterPlanes::channels];  ///< details within their bounds; none with a guide
    explicit FilteredRow(int width);
};

/// struct Level of a_trous.comp, for one row of pixels.
void filter_row(const FilterPlanes& planes, const FilterRules& rules, int y, FilteredRow& result);
/// guided() of a_trous.comp.
void filter_guided_row(const FilterPlanes& planes, const FilterRules& rules, int y, FilteredRow& result);

}  // namespace ir::passes::a_trous
