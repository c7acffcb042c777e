#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderers/plot/plot_data.h"
#include "renderers/plot/plot_scale.h"
#include "renderers/plot/plot_style.h"

namespace ir {

/// A plot on axes of some size: what a window and a file draw alike.
struct PlacedPlot {
    /// A point where it is drawn.
    struct Mark {
        std::string id;
        int series = 0;
        std::size_t point = 0;  ///< of the series
        double x = 0, y = 0;    ///< places on the axes
        bool ring = false, displaced = false;
        bool shown = true;    ///< false: a line alone passes here
        bool begins = false;  ///< no line comes from the point before
        double value = 0;     ///< of a tile; of a bar the place where it begins
    };
    /// What the colours of a heat map span.
    struct Heat {
        double low = 0, high = 1;
        bool log = false;  ///< where values span more than a decade

        PlotColour colour(double value) const;
        PlotColour ink(double value) const;  ///< that can be read upon it
        double at(double fraction) const;    ///< the value at a place along the colours
    };
    PlotScale x, y;
    std::vector<Mark> marks;  ///< points that have a place, in the order of series, then points
    bool shows_level = false;
    std::optional<Heat> heat = {};  ///< marks are tiles from −½ to +½ of their places
    /// Points whose values the axes cannot show, and levels that lie far from all points: a line each.
    std::vector<std::string> remarks = {};

    bool has_rings() const;
};

/// For axes of that many logical pixels.
PlacedPlot place_plot(const PlotData& data, double width, double height);

/// Logical pixels of a tile, in which its value can be written.
inline constexpr double min_tile_width = 44, min_tile_height = 16;

/// Of a mark: many points have small ones.
inline double mark_radius(std::size_t marks) {
    return marks > 400 ? 3 : 4.5;
}

}  // namespace ir
