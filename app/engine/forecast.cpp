#include "app/engine/forecast.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>

namespace ir::engine {
namespace {

using projects::Json;

/// A number, or the product of several: a size costs as many pixels as it has. Nothing for words.
std::optional<double> number_of(const Json& value) {
    if (value.is_number()) return value.get<double>();
    if (!value.is_array() || value.empty()) return {};
    double product = 1;
    for (const auto& part : value) {
        if (!part.is_number()) return {};
        product *= part.get<double>();
    }
    return product;
}

/// One axis: its values in order, each once.
struct Axis {
    std::string key;
    std::map<Json, std::size_t> places = {};  ///< of values, by rank where they are numbers
    std::vector<double> positions = {};       ///< of numbers, from 0 to 1; empty: words
    std::size_t place_of(const Json& coordinates) const { return places.at(coordinates.value(key, Json())); }
};

/// By the logarithm, or, where some are not above 0, by rank.
std::vector<double> positions_of(const std::vector<double>& ascending) {
    const auto last = static_cast<double>(std::max<std::size_t>(1, ascending.size() - 1));
    const double range = std::log(ascending.back() / ascending.front());
    std::vector<double> positions;
    for (std::size_t i = 0; i < ascending.size(); ++i)
        positions.push_back(ascending.front() > 0 && range > 0
                                ? std::log(ascending[i] / ascending.front()) / range
                                : static_cast<double>(i) / last);
    return positions;
}

std::vector<Axis> axes_of(const Coordinates& all) {
    std::vector<Axis> axes;
    if (all.empty()) return axes;
    for (const auto& [key, unused] : all.front().items()) {
        std::set<Json> distinct;
        for (const auto& each : all) distinct.insert(each.value(key, Json()));
        std::vector<Json> values(distinct.begin(), distinct.end());
        Axis axis{key};
        if (std::ranges::all_of(values, [](const Json& value) { return number_of(value).has_value(); })) {
            std::ranges::sort(values, {}, [](const Json& value) { return *number_of(value); });
            std::vector<double> numbers;
            for (const auto& value : values) numbers.push_back(*number_of(value));
            axis.positions = positions_of(numbers);
        }
        for (const auto& value : values) axis.places.emplace(value, axis.places.size());
        axes.push_back(std::move(axis));
    }
    return axes;
}

/// The terms of the law at one variation, each from 0 to 1.
std::vector<double> terms_of(const std::vector<Axis>& axes, const Json& coordinates) {
    std::vector<double> terms{1};
    for (const auto& axis : axes) {
        const auto place = axis.place_of(coordinates);
        if (!axis.positions.empty()) terms.push_back(axis.positions[place]);
        for (std::size_t i = 1; axis.positions.empty() && i < axis.places.size(); ++i)
            terms.push_back(i == place ? 1 : 0);
    }
    return terms;
}

/// Solves A x = b, A symmetric and positive, by elimination.
std::vector<double> solved(std::vector<std::vector<double>> a, std::vector<double> b) {
    const auto n = b.size();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t row = i + 1; row < n; ++row) {
            const double factor = a[row][i] / a[i][i];
            for (std::size_t column = i; column < n; ++column) a[row][column] -= factor * a[i][column];
            b[row] -= factor * b[i];
        }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t column = i + 1; column < n; ++column) b[i] -= a[i][column] * b[column];
        b[i] /= a[i][i];
    }
    return b;
}

/// A law of the terms: `least` and the exponential of their weighted sum.
struct Law {
    double least = 0;
    std::vector<double> factors = {};
    double residual = 0;
    double at(const std::vector<double>& terms) const {
        return least + std::exp(std::inner_product(terms.begin(), terms.end(), factors.begin(), 0.0));
    }
};

/// Least squares of the logarithms, in which large values count more, as they do in the sum. Of terms that no
/// measurement tells apart the smallest factors are taken.
Law fitted(const std::vector<std::vector<double>>& terms, const std::vector<double>& values, double least) {
    constexpr double smallness = 1e-3;
    const auto n = terms.front().size();
    const double largest = *std::ranges::max_element(values);
    std::vector<double> logs, weights;
    for (const double value : values) {
        logs.push_back(std::log(value - least));
        weights.push_back(std::sqrt(value / largest));
    }
    const double mean = std::inner_product(logs.begin(), logs.end(), weights.begin(), 0.0) /
                        std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<std::vector<double>> a(n, std::vector<double>(n, 0));
    std::vector<double> b(n, 0);
    for (std::size_t m = 0; m < terms.size(); ++m)
        for (std::size_t i = 0; i < n; ++i) {
            b[i] += weights[m] * terms[m][i] * (logs[m] - mean);
            for (std::size_t j = 0; j < n; ++j) a[i][j] += weights[m] * terms[m][i] * terms[m][j];
        }
    for (std::size_t i = 0; i < n; ++i) a[i][i] += smallness;
    Law law{least, solved(std::move(a), std::move(b))};
    law.factors[0] += mean;
    for (std::size_t m = 0; m < terms.size(); ++m) {
        const double error = std::log(law.at(terms[m]) / values[m]);
        law.residual += weights[m] * error * error;
    }
    return law;
}

/// Of several values that each variation takes at least the one that explains most.
Law best_law(const std::vector<std::vector<double>>& terms, const std::vector<double>& values) {
    const double smallest = *std::ranges::min_element(values);
    auto best = fitted(terms, values, 0);
    for (const double part : {0.3, 0.6, 0.8}) {
        constexpr double clearly = 0.9;
        if (auto law = fitted(terms, values, part * smallest); law.residual < clearly * best.residual)
            best = std::move(law);
    }
    return best;
}

}  // namespace

std::size_t enough_probes(const Coordinates& all) {
    constexpr std::size_t spare = 4;
    if (all.empty()) return 0;
    return std::min(all.size(), terms_of(axes_of(all), all.front()).size() + spare);
}

std::vector<std::size_t> probes_of(const Coordinates& all, std::size_t count) {
    const auto axes = axes_of(all);
    std::vector<std::vector<std::size_t>> places(all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        for (const auto& axis : axes) places[i].push_back(axis.place_of(all[i]));
    std::vector<std::vector<std::size_t>> uses;  // of each value of each axis
    for (const auto& axis : axes) uses.emplace_back(axis.places.size(), 0);
    // In an order that is spread over the grid.
    std::vector<std::size_t> order(all.size()), probes;
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto spread = [](std::size_t i) {
        constexpr double golden = 0.6180339887498949;
        return std::fmod(static_cast<double>(i) * golden, 1.0);
    };
    std::ranges::sort(order, {}, spread);
    std::vector<bool> is_taken(all.size(), false);
    while (probes.size() < std::min(count, all.size())) {
        const auto cost = [&](std::size_t i) {
            double sum = is_taken[i] ? 1e300 : 0;
            for (std::size_t a = 0; a < axes.size(); ++a)
                if (!probes.empty())
                    sum += static_cast<double>(uses[a][places[i][a]]);
                else if (!axes[a].positions.empty())
                    sum -= axes[a].positions[places[i][a]];
            return sum;
        };
        const auto chosen = *std::ranges::min_element(order, {}, cost);
        is_taken[chosen] = true;
        for (std::size_t a = 0; a < axes.size(); ++a) ++uses[a][places[chosen][a]];
        probes.push_back(chosen);
    }
    return probes;
}

double predicted_sum(const Coordinates& all, const Measurements& measured) {
    constexpr double least = 1e-9;  // a logarithm needs more than 0
    if (measured.empty()) return 0;
    const auto axes = axes_of(all);
    std::vector<std::vector<double>> terms;
    std::vector<double> values;
    for (const auto& [number, value] : measured) {
        terms.push_back(terms_of(axes, all[number]));
        values.push_back(std::max(value, least));
    }
    const auto law = best_law(terms, values);
    double sum = 0, by_law = 0, by_measurement = 0;
    for (const auto& each : all) sum += law.at(terms_of(axes, each));
    for (std::size_t m = 0; m < measured.size(); ++m) {
        by_law += law.at(terms[m]);
        by_measurement += measured[m].second;
    }
    return sum * by_measurement / by_law;
}

}  // namespace ir::engine
