#include "app/engine/analysis/sensitivity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "app/engine/analysis/analysis_run.h"
#include "app/engine/analysis/bars.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/transport.h"

namespace ir::engine {
namespace {

constexpr int steps = 8;                  ///< over the whole range
constexpr double factor_of_logs = 20;     ///< from here on steps are factors
constexpr std::size_t max_pictures = 12;  ///< of the parameters that change most
constexpr const char* seed_key = "seed";

/// To three digits, so that people can read it.
double rounded(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return std::strtod(text, nullptr);
}

bool is_numeric(const ParameterDescription& parameter) {
    return parameter.type == ParameterType::integer || parameter.type == ParameterType::number;
}

/// What became of one side of a parameter.
struct Moved {
    bool is_there = false;
    std::string value;
    double change = 0, error = 0;
};

/// A parameter, or the seed, with both sides.
struct NumberRow {
    std::string key, label;
    std::array<Moved, 2> sides = {};
    Image matters = {};
    double largest() const {
        double most = 0;
        for (const auto& side : sides)
            if (side.is_there) most = std::max(most, std::abs(side.change));
        return most;
    }
};

class Sensitivity {
  public:
    explicit Sensitivity(AnalysisRun& run) : run_(run), base_(run.experiment(0)) {}

    AnalysisResult answer() {
        const auto parameters = chosen();
        run_.expect(2 + 2 * parameters.size() + (run_.has_reference() ? 1 : 0));
        base_picture_ = run_.picture(base_, run_.name(0));
        if (run_.has_reference()) base_error_ = run_.rmse(base_picture_, run_.reference());
        for (const auto* parameter : parameters) add(*parameter);
        add_seed();
        std::ranges::stable_sort(rows_, std::ranges::greater{}, &NumberRow::largest);
        return result();
    }

  private:
    /// Those that may change the picture; of the others it is said why not.
    std::vector<const ParameterDescription*> chosen() {
        std::vector<const ParameterDescription*> parameters;
        std::vector<std::string> inactive, costs, transport;
        const auto& wanted = run_.analysis().parameters;
        for (const auto& parameter : run_.method().parameters) {
            const bool is_wanted = wanted.empty() || std::ranges::find(wanted, parameter.key) != wanted.end();
            if (!is_wanted) continue;
            if (!is_numeric(parameter)) {
                if (!wanted.empty()) problems_.push_back(parameter.label + ": is no number");
            } else if (parameter.effect == Effect::cost) {
                costs.push_back(parameter.label);
            } else if (wanted.empty() && run_.has_reference() && is_transport_key(parameter.key)) {
                transport.push_back(parameter.label);
            } else if (!is_active(parameter, base_.values)) {
                inactive.push_back(parameter.label);
            } else {
                parameters.push_back(&parameter);
            }
        }
        if (!inactive.empty()) problems_.push_back("without a meaning here: " + projects::listed(inactive));
        if (!transport.empty())
            problems_.push_back("ask for other light than the reference has: " + projects::listed(transport));
        if (!costs.empty())
            problems_.push_back("change only what the picture costs: " + projects::listed(costs));
        if (!wanted.empty() && parameters.empty())
            throw UsageError("no parameter to step: " +
                             projects::printable(projects::listed(problems_), 300));
        return parameters;
    }

    void add(const ParameterDescription& parameter) {
        NumberRow row{parameter.key, parameter.label};
        bool has_steps = false, has_failed = false;
        for (const int direction : {-1, 1}) {
            const auto value = stepped(parameter, base_.values.at(parameter.key), direction);
            if (!value) continue;
            has_steps = true;
            auto varied = base_;
            varied.values[parameter.key] = *value;
            try {
                add_side(row, direction > 0, to_string(*value), varied);
            } catch (const Error& error) {
                if (run_.is_device_lost()) throw;
                has_failed = true;
                problems_.push_back(parameter.label + " " + to_string(*value) + ": " +
                                    projects::printable(error.what(), 300));
            }
        }
        if (!has_steps) problems_.push_back(parameter.label + ": has no range that says how long a step is");
        // Of what was not tried, or failed, nobody knows that it has no effect.
        if (!row.matters.empty() || (has_steps && !has_failed)) keep(std::move(row));
    }

    /// What noise alone changes.
    void add_seed() {
        NumberRow row{seed_key, "Another seed"};
        auto varied = base_;
        varied.seed = base_.seed == 1 ? 2 : 1;
        add_side(row, true, std::to_string(varied.seed), varied);
        keep(std::move(row));
    }

    void add_side(NumberRow& row, bool is_up, const std::string& value, const projects::Experiment& varied) {
        const auto picture = run_.picture(varied, row.label + " " + value);
        if (picture.pixels == base_picture_.pixels) return;
        auto& side = row.sides[is_up];
        side.is_there = true;
        side.value = value;
        side.error = run_.rmse(picture, run_.has_reference() ? run_.reference() : base_picture_);
        side.change = side.error - base_error_;
        const auto distance = run_.distance(picture, base_picture_);
        if (row.matters.empty()) row.matters = Image(distance.width, distance.height, 1);
        for (std::size_t i = 0; i < distance.pixels.size(); ++i)
            row.matters.pixels[i] = std::max(row.matters.pixels[i], distance.pixels[i]);
    }

    void keep(NumberRow row) {
        if (row.matters.empty()) {
            if (row.key != seed_key) without_effect_.push_back(row.label);
            return;
        }
        rows_.push_back(std::move(row));
        std::ranges::stable_sort(rows_, std::ranges::greater{}, &NumberRow::largest);
        if (rows_.size() > max_pictures) rows_.back().matters = {};
    }

    AnalysisResult result() {
        AnalysisResult result;
        const bool is_judged = run_.has_reference();
        const auto error = run_.error_title("the picture as it is");
        Bars bars("Sensitivity of " + run_.name(0), is_judged ? "Change of the " + error : error,
                  {"Parameter", "As it is", "Value", error, "Change"}, {"a step down", "a step up"});
        for (auto& row : rows_) {
            const auto now =
                row.key == seed_key ? std::to_string(base_.seed) : to_string(base_.values.at(row.key));
            bars.begin_row(row.label);
            for (int up = 0; up < 2; ++up) {
                const auto& side = row.sides[std::size_t(up)];
                if (side.is_there)
                    bars.add(
                        row.key + (up ? ":up" : ":down"), 0, side.change,
                        {{row.label}, {now}, {side.value}, number_cell(side.error), change_cell(side.change)},
                        up);
            }
            if (!row.matters.empty())
                result.pictures.push_back({row.key,
                                           row.label,
                                           "Where a step of it changes the picture: the larger of the two "
                                           "distances.",
                                           false,
                                           {},
                                           std::move(row.matters)});
        }
        for (const auto& line : problems_) bars.add_problem(line);
        if (!without_effect_.empty())
            bars.add_problem("a step changes no pixel: " + projects::listed(without_effect_));
        if (is_judged) run_.note("as it is: " + error + " " + number_cell(base_error_).text);
        run_.note("what is no larger than another seed's change may be noise");
        result.data = std::move(bars).finish(run_.notes());
        return result;
    }

    AnalysisRun& run_;
    const projects::Experiment base_;
    Image base_picture_;
    double base_error_ = 0;  ///< without a reference the picture is its own
    std::vector<NumberRow> rows_;
    std::vector<std::string> problems_, without_effect_;
};

}  // namespace

std::optional<Value> stepped(const ParameterDescription& parameter, const Value& value, int direction) {
    const bool is_whole = parameter.type == ParameterType::integer;
    const double now = is_whole ? double(std::get<std::int64_t>(value)) : std::get<double>(value);
    const auto range =
        std::isfinite(parameter.soft.max - parameter.soft.min) ? parameter.soft : parameter.hard;
    if (!std::isfinite(range.max - range.min) || !(range.max > range.min)) return {};
    const bool is_factor = range.min > 0 && range.max >= factor_of_logs * range.min && now > 0;
    const double next = is_factor ? rounded(now * std::pow(range.max / range.min, double(direction) / steps))
                                  : rounded(now + direction * (range.max - range.min) / steps);
    // 0 often means that there is none, or no limit; and the least that is allowed is no step.
    const double next_or_half = direction < 0 && now > 0 && next <= 0 ? now / 2 : next;
    const double moved = is_whole ? (direction > 0 ? std::max(std::round(next_or_half), now + 1)
                                                   : std::min(std::round(next_or_half), now - 1))
                                  : next_or_half;
    const double kept = std::clamp(moved, parameter.hard.min, parameter.hard.max);
    if (kept == now) return {};
    return parameter.checked(is_whole ? Value(std::int64_t(kept)) : Value(kept));
}

AnalysisResult sensitivity(AnalysisRun& run) {
    return Sensitivity(run).answer();
}

}  // namespace ir::engine
