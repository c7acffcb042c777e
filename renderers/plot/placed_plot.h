#pragma once

#include <string>
#include <vector>

#include "renderers/plot/plot_data.h"
#include "renderers/plot/plot_scale.h"

namespace ir {

/// A plot on axes of some size: what a window and a file draw alike.
struct PlacedPlot {
    /// A point where it is drawn.
    struct Mark {
        std::string id;
        int series = 0;
        double x = 0, y = 0;  ///< places on the axes
        bool ring = false, displaced = false;
        bool shown = true;    ///< false: a line alone passes here
        bool begins = false;  ///< no line comes from the point before
    };
    PlotScale x, y;
    std::vector<Mark> marks;  ///< points that have a place, in the order of series, then points
    bool shows_level = false;
    /// Points whose values the axes cannot show, and levels that lie far from all points: a line each.
    std::vector<std::string> remarks;

    bool has_rings() const;
};

/// For axes of that many logical pixels.
PlacedPlot place_plot(const PlotData& data, double width, double height);

/// Of a mark: many points have small ones.
inline double mark_radius(std::size_t marks) {
    return marks > 400 ? 3 : 4.5;
}

}  // namespace ir
