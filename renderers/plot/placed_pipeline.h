#pragma once

#include <vector>

#include "renderers/plot/pipeline.h"
#include "renderers/plot/plot_style.h"

namespace ir {

/// A pipeline with the places of its boxes and lines, in logical pixels from the top left corner: what a
/// window and a file draw alike.
struct PlacedPipeline {
    static constexpr double font = 11, row_height = 17, padding = 5;
    static constexpr double picture_width = 48, picture_height = 32;  ///< of a small picture in a row
    struct Point {
        double x = 0, y = 0;
    };
    struct Box {
        double x = 0, y = 0, width = 0, height = 0;
    };
    /// Cubic Béziers, each from where the one before ends; the tip of the arrow follows the last.
    struct Line {
        std::vector<Point> points;
        Point tip;
    };
    double width = 0, height = 0;
    std::vector<std::vector<Box>> rows;  ///< by node and row
    std::vector<Box> boxes;              ///< by node
    std::vector<Line> lines;             ///< by edge
};

/// By Graphviz, in which one thread works at a time. `has_pictures`: rows that are pictured have room for
/// one. Throws Error where Graphviz cannot.
PlacedPipeline place_pipeline(const Pipeline& pipeline, bool has_pictures);

/// How a row is filled: passes by time, buffers by memory.
PlotColour heat_colour(const PlotStyle& style, bool is_pass, double heat);

}  // namespace ir
