#pragma once

#include <functional>
#include <vector>

#include "renderers/image/flip_filters.h"

namespace ir::flip {

/// Fills a row of linear red, green and blue, each of the image's width, with values of 0 … 1.
using RowSource = std::function<void(int y, float* red, float* green, float* blue)>;

/// LDR-ꟻLIP of pictures of one size; keeps its memory from map to map. [Andersson20]
class Map {
  public:
    Map(int width, int height, double pixels_per_degree);

    /// The error of each pixel, 0 … 1. Beyond the border the border's pixels go on. Sources are called from
    /// several threads.
    const std::vector<float>& compute(const RowSource& image, const RowSource& reference);

  private:
    /// What remains of a picture after filtering along rows, one value a pixel each.
    enum Plane { luminance, red_green, blue_yellow_a, blue_yellow_b, edge, point, smooth, plane_count };
    struct Filtered {
        std::vector<float> planes[plane_count];
    };
    struct Row;

    void filter_row(const RowSource& source, Filtered& filtered, int y) const;
    void filter_columns(const Filtered& filtered, Row& row, int y) const;
    void compare_row(const Row& image, const Row& reference, float* error) const;

    int width_, height_, margin_;
    ContrastSensitivity contrast_;
    FeatureDetectors features_;
    Filtered filtered_[2];
    std::vector<float> error_;
};

}  // namespace ir::flip
