#include "app/engine/study_plot.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/bytes_text.h"
#include "renderers/image/metrics.h"
#include "renderers/plot/plot_scale.h"

namespace ir::engine {
namespace {

using projects::Json;

constexpr std::size_t max_named_values = 12;

std::string with_unit(const std::string& name, const std::string& unit) {
    return unit.empty() ? name : name + " (" + unit + ")";
}

const MetricDescription* known_metric(const std::string& name) {
    for (const auto& each : metrics())
        if (each.name == name) return &each;
    return nullptr;
}

std::string unit_of(const std::string& metric) {
    const auto* known = known_metric(metric);
    return known ? known->unit : std::string();
}

std::string metric_label(const std::string& name) {
    const auto* known = known_metric(name);
    return known ? known->label : name;
}

double error_of(const ErrorPoint& point, const std::string& metric) {
    const auto found = point.errors.find(metric);
    return found == point.errors.end() ? std::nan("") : found->second;
}

PlotCell error_cell(const ErrorPoint& point, const std::string& metric) {
    const double error = error_of(point, metric);
    if (std::isnan(error)) return {"—"};
    return {plot_number(error), error};
}

class Drawing {
  public:
    Drawing(const projects::Project& project, const Registry& registry, const projects::ErrorPlot& plot,
            const ErrorStudy& study, const PlotLook& look)
        : project_(project), registry_(registry), plot_(plot), study_(study), look_(look) {
        over_ = key_label();
        const bool numbers = std::all_of(study.points.begin(), study.points.end(),
                                         [](const ErrorPoint& point) { return point.value.is_number(); });
        if (!numbers)
            for (const auto& point : study.points)
                if (const auto text = value_text(point.value); index_of_name(text) == names_.size())
                    names_.push_back(text);
    }

    DrawnStudy draw() {
        data_.title = (plot_.name.empty() ? plot_.id : plot_.name);
        draw_axes();
        data_.ring_name = "front: no other is faster and better";
        data_.join_rings = plot_.against_time;
        auto& headings = data_.headings;
        if (names_experiments()) headings.push_back("Experiment");
        headings.insert(headings.end(), {over_.first, metric_heading(plot_.metric), "ms"});
        for (const auto& metric : study_.metrics)
            if (metric != plot_.metric) headings.push_back(metric_heading(metric));
        headings.insert(headings.end(), {"Memory", "Front"});
        for (const auto& point : study_.points) draw_point(point);
        if (plot_.metric == "rmse" && study_.reference_noise > 0)
            data_.level = PlotLevel{study_.reference_noise, "reference's own noise"};
        data_.notes = study_.notes;
        return {std::move(data_), why_no_log_x_, why_no_log_y_};
    }

  private:
    bool names_experiments() const {
        const auto& points = study_.points;
        return plot_.experiments.size() > 1 ||
               std::any_of(points.begin(), points.end(), [&](const ErrorPoint& point) {
                   return point.experiment != points.front().experiment;
               });
    }

    /// What the values are called, and their unit.
    std::pair<std::string, std::string> key_label() const {
        if (look_.over == "frames") return {"Frames", ""};
        if (look_.over == "seed") return {"Seed", ""};
        for (const auto& point : study_.points) {
            const auto* experiment = projects::find_item(project_.experiments, point.experiment);
            const auto* method = experiment ? registry_.find(experiment->method) : nullptr;
            const auto* parameter = method ? ir::find(method->parameters, look_.over) : nullptr;
            if (parameter) return {(parameter->label), parameter->unit};
        }
        return {(look_.over), ""};
    }

    double place_of(const ErrorPoint& point) const {
        if (plot_.against_time) return point.ms;
        if (!names_.empty()) return double(index_of_name(value_text(point.value)));
        return point.value.get<double>();
    }

    void draw_axes() {
        auto& x = data_.x;
        const auto is_there = [](const ErrorPoint& point) { return point.problem.empty(); };
        if (plot_.against_time) {
            x.title = "Time of rendering (ms)";
        } else {
            x.title = with_unit(over_.first, over_.second);
            x.names = names_;
            if (!names_.empty()) why_no_log_x_ = "The values are no numbers.";
            for (const auto& point : study_.points) {
                if (!names_.empty() || !is_there(point)) continue;
                if (place_of(point) <= 0) why_no_log_x_ = "Not all values are above zero.";
                if (std::find(x.wanted.begin(), x.wanted.end(), place_of(point)) == x.wanted.end())
                    x.wanted.push_back(place_of(point));
            }
            if (x.wanted.size() > max_named_values) x.wanted.clear();
        }
        const auto* metric = known_metric(plot_.metric);
        data_.y.title = metric_heading(plot_.metric);
        if (metric && metric->best == Best::highest)
            why_no_log_y_ = "More is better in " + metric->label + ": it is drawn as it is.";
        for (const auto& point : study_.points)
            if (is_there(point) && error_of(point, plot_.metric) < 0)
                why_no_log_y_ = "Not all errors are above zero.";
        x.log = look_.log_x && why_no_log_x_.empty();
        data_.y.log = look_.log_y && why_no_log_y_.empty();
    }

    std::string name_of(const std::string& experiment) const {
        const auto* found = projects::find_item(project_.experiments, experiment);
        return (found && !found->name.empty() ? found->name : experiment);
    }

    PlotSeries& series_of(const std::string& experiment) {
        for (std::size_t i = 0; i < experiments_.size(); ++i)
            if (experiments_[i] == experiment) return data_.series[i];
        experiments_.push_back(experiment);
        data_.series.push_back({name_of(experiment), {}});
        return data_.series.back();
    }

    void draw_point(const ErrorPoint& point) {
        const auto value = value_text(point.value);
        if (!point.problem.empty()) {
            data_.problems.push_back(name_of(point.experiment) + ", " + over_.first + " = " + value + ": " +
                                     point.problem);
            return;
        }
        PlotPoint drawn;
        drawn.id = point_id(point);
        drawn.x = place_of(point);
        drawn.y = error_of(point, plot_.metric);
        drawn.ring = point.on_front;
        drawn.label = label_of(point);
        if (names_experiments()) drawn.cells.push_back({name_of(point.experiment)});
        drawn.cells.push_back(
            {value, point.value.is_number() ? std::optional(point.value.get<double>()) : std::nullopt});
        drawn.cells.push_back(error_cell(point, plot_.metric));
        drawn.cells.push_back({plot_number(point.ms), point.ms});
        for (const auto& metric : study_.metrics)
            if (metric != plot_.metric) drawn.cells.push_back(error_cell(point, metric));
        drawn.cells.push_back({bytes_text(point.memory_bytes), double(point.memory_bytes)});
        drawn.cells.push_back({point.on_front ? "●" : std::string()});
        series_of(point.experiment).points.push_back(std::move(drawn));
    }

    std::string label_of(const ErrorPoint& point) const {
        auto text = name_of(point.experiment) + "\n" + over_.first + " = " + value_text(point.value) + "\n" +
                    plot_number(point.ms) + " ms\n" + metric_label(plot_.metric) + " " +
                    plot_number(error_of(point, plot_.metric));
        if (const auto unit = unit_of(plot_.metric); !unit.empty()) text += " " + unit;
        text += "\n" + bytes_text(point.memory_bytes);
        if (point.on_front) text += "\n" + data_.ring_name;
        return text;
    }

    std::size_t index_of_name(const std::string& text) const {
        return std::size_t(std::find(names_.begin(), names_.end(), text) - names_.begin());
    }

    const projects::Project& project_;
    const Registry& registry_;
    const projects::ErrorPlot& plot_;
    const ErrorStudy& study_;
    const PlotLook& look_;
    std::pair<std::string, std::string> over_;
    std::vector<std::string> names_;  ///< of values that are no numbers
    std::vector<std::string> experiments_;
    PlotData data_;
    std::string why_no_log_x_, why_no_log_y_;
};

}  // namespace

std::string value_text(const Json& value) {
    const bool is_size =
        value.is_array() && value.size() == 2 && value[0].is_number() && value[1].is_number();
    if (is_size) return value[0].dump() + "×" + value[1].dump();
    return value.is_string() ? value.get<std::string>() : value.is_null() ? std::string() : value.dump();
}

std::string point_id(const ErrorPoint& point) {
    return point.experiment + "=" + point.value.dump();
}

const ErrorPoint* find_point(const ErrorStudy& study, const std::string& id) {
    for (const auto& point : study.points)
        if (point_id(point) == id) return &point;
    return nullptr;
}

std::string metric_heading(const std::string& name) {
    return with_unit(metric_label(name), unit_of(name));
}

DrawnStudy draw_study(const projects::Project& project, const Registry& registry,
                      const projects::ErrorPlot& plot, ErrorStudy study, const PlotLook& look) {
    engine::mark_front(study.points, plot.metric);
    return Drawing(project, registry, plot, study, look).draw();
}

}  // namespace ir::engine
