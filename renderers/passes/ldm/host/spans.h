#pragma once

#include <algorithm>
#include <cmath>

#include "renderers/passes/ldm/maps.h"

namespace ir::passes::ldm {

/// Rows of a triangle and the texels of each whose centres it covers. Corners are whole subtexels.
class Spans {
  public:
    /// Rows from `top` up to `bottom`, columns from 0 up to `resolution`.
    Spans(const double (&x)[3], const double (&y)[3], int top, int bottom, int resolution)
        : resolution_(resolution) {
        int order[3] = {0, 1, 2};
        std::sort(order, order + 3, [&](int a, int b) { return y[a] < y[b]; });
        for (int i = 0; i < 3; ++i) x_[i] = x[order[i]], y_[i] = y[order[i]];
        row_ = std::max(first_centre(y_[0]), top) - 1;
        end_row_ = std::min(first_centre(y_[2]), bottom);
    }
    /// Goes to the next row that has any; false: there is none.
    bool next() {
        while (++row_ < end_row_) {
            const double y = subtexels * (row_ + 0.5);
            const int a = column(0, 2, y), b = y < y_[1] ? column(0, 1, y) : column(1, 2, y);
            first_ = std::max(std::min(a, b), 0);
            end_ = std::min(std::max(a, b), resolution_);
            if (first_ < end_) return true;
        }
        return false;
    }
    int row() const { return row_; }
    int first() const { return first_; }
    int end() const { return end_; }  ///< one after the last

  private:
    static int first_centre(double subtexel) {
        return static_cast<int>(std::ceil((subtexel - 0.5 * subtexels) / subtexels));
    }
    /// First column whose centre is not left of the edge. Divided once, the quotient of whole numbers below
    /// 2^42 lies on the right side of every whole number.
    int column(int from, int to, double y) const {
        const double height = y_[to] - y_[from];
        const double numerator = (x_[from] - 0.5 * subtexels) * height + (y - y_[from]) * (x_[to] - x_[from]);
        return static_cast<int>(std::ceil(numerator / (subtexels * height)));
    }
    double x_[3], y_[3];
    int resolution_, row_, end_row_, first_ = 0, end_ = 0;
};

/// Depth of a triangle's plane above subtexel coordinates.
struct Plane {
    double depth, per_x, per_y, x, y;
    Plane(const double (&xs)[3], const double (&ys)[3], const double (&zs)[3])
        : depth(zs[0]), per_x(0), per_y(0), x(xs[0]), y(ys[0]) {
        const double bx = xs[1] - x, by = ys[1] - y, cx = xs[2] - x, cy = ys[2] - y, area = bx * cy - by * cx;
        if (area == 0) return;
        const double bz = (zs[1] - zs[0]) / area, cz = (zs[2] - zs[0]) / area;
        per_x = bz * cy - cz * by;
        per_y = cz * bx - bz * cx;
    }
    double at(double px, double py) const { return depth + per_x * (px - x) + per_y * (py - y); }
};

}  // namespace ir::passes::ldm
