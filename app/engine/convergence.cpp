#include "app/engine/convergence.h"

#include <cmath>
#include <limits>

namespace ir::engine {
namespace {

double ms_of(const ConvergencePoint& a, const ConvergencePoint& b, double samples) {
    const double from = double(a.samples), to = double(b.samples);
    return a.ms + (b.ms - a.ms) * (samples - from) / (to - from);
}

double samples_between(const ConvergencePoint& a, const ConvergencePoint& b, double squared_error) {
    const double part =
        std::log(squared_error / a.squared_error) / std::log(b.squared_error / a.squared_error);
    return double(a.samples) * std::pow(double(b.samples) / double(a.samples), part);
}

}  // namespace

double ms_to_error(const std::vector<ConvergencePoint>& points, double squared_error) {
    if (!(squared_error > 0)) return std::numeric_limits<double>::infinity();
    if (points.front().squared_error <= squared_error) return points.front().ms;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const auto &before = points[i - 1], &after = points[i];
        if (after.squared_error > squared_error) continue;
        if (!(after.squared_error > 0)) return after.ms;
        return ms_of(before, after, samples_between(before, after, squared_error));
    }
    const auto& last = points.back();
    return ms_of(points[points.size() - 2], last, double(last.samples) * last.squared_error / squared_error);
}

}  // namespace ir::engine
