// Rows of triangles of any size. Read once for each instruction set, within a source that includes
// <hwy/foreach_target.h>.
#include <algorithm>
#include <cmath>

#include "renderers/passes/ldm/host/lanes.inl"
#include "renderers/passes/ldm/maps.h"

#if defined(IR_LDM_HOST_SPANS) == defined(HWY_TARGET_TOGGLE)
#ifdef IR_LDM_HOST_SPANS
#undef IR_LDM_HOST_SPANS
#else
#define IR_LDM_HOST_SPANS
#endif

HWY_BEFORE_NAMESPACE();
namespace ir::passes::ldm::HWY_NAMESPACE {
namespace {

/// Rows of a triangle and the texels of each whose centres it covers, found for some rows at once. Corners
/// are whole subtexels.
class Spans {
  public:
    /// Rows from `top` up to `bottom`, columns from 0 up to `resolution`.
    Spans(const double (&x)[3], const double (&y)[3], int top, int bottom, int resolution)
        : resolution_(resolution) {
        int order[3] = {0, 1, 2};
        std::sort(order, order + 3, [&](int a, int b) { return y[a] < y[b]; });
        for (int i = 0; i < 3; ++i) x_[i] = x[order[i]], y_[i] = y[order[i]];
        first_row_ = std::max(first_centre(y_[0]), top);
        row_ = first_row_ - 1;
        end_row_ = std::min(first_centre(y_[2]), bottom);
    }
    /// Goes to the next row that has any; false: there is none.
    bool next() {
        while (++row_ < end_row_) {
            at_ = (row_ - first_row_) % rows;
            if (at_ == 0) find_rows();
            if (firsts_[at_] < ends_[at_]) return true;
        }
        return false;
    }
    int row() const { return row_; }
    int first() const { return static_cast<int>(firsts_[at_]); }
    int end() const { return static_cast<int>(ends_[at_]); }  ///< one after the last

  private:
    using Tag = hn::CappedTag<double, 8>;
    using Doubles = hn::Vec<Tag>;
    static constexpr Tag d{};
    static constexpr int rows = static_cast<int>(hn::MaxLanes(Tag()));

    static int first_centre(double subtexel) {
        return static_cast<int>(std::ceil((subtexel - 0.5 * subtexels) / subtexels));
    }
    void find_rows() {
        const auto y = hn::Add(hn::Iota(d, subtexels * (row_ + 0.5)),
                               hn::Mul(hn::Iota(d, 0), hn::Set(d, subtexels - 1)));
        const auto is_upper = hn::Lt(y, hn::Set(d, y_[1]));
        const auto either = [&](double upper, double lower) {
            return hn::IfThenElse(is_upper, hn::Set(d, upper), hn::Set(d, lower));
        };
        const auto a = column(y, hn::Set(d, x_[0]), hn::Set(d, y_[0]), hn::Set(d, x_[2] - x_[0]),
                              hn::Set(d, y_[2] - y_[0]));
        const auto b = column(y, either(x_[0], x_[1]), either(y_[0], y_[1]),
                              either(x_[1] - x_[0], x_[2] - x_[1]), either(y_[1] - y_[0], y_[2] - y_[1]));
        hn::StoreU(hn::Max(hn::Min(a, b), hn::Zero(d)), d, firsts_);
        hn::StoreU(hn::Min(hn::Max(a, b), hn::Set(d, resolution_)), d, ends_);
    }
    /// First column whose centre is not left of the edge from (x, y). Divided once, the quotient of whole
    /// numbers below 2^42 lies on the right side of every whole number.
    static Doubles column(Doubles centre, Doubles x, Doubles y, Doubles width, Doubles height) {
        const auto numerator = hn::Add(hn::Mul(hn::Sub(x, hn::Set(d, 0.5 * subtexels)), height),
                                       hn::Mul(hn::Sub(centre, y), width));
        return hn::Ceil(hn::Div(numerator, hn::Mul(hn::Set(d, subtexels), height)));
    }

    double x_[3], y_[3], resolution_;
    int first_row_, row_, end_row_, at_ = 0;
    double firsts_[rows], ends_[rows];
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

}  // namespace
}  // namespace ir::passes::ldm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
