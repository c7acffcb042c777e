#include "app/gui/plot_points.h"

#include <QObject>
#include <algorithm>
#include <cmath>

#include "app/gui/text_of.h"
#include "renderers/image/metrics.h"
#include "widgets/models/report_rows.h"
#include "widgets/plot/plot_scale.h"

namespace ir::gui {
namespace {

using engine::ErrorPoint;
using engine::ErrorStudy;
using projects::Json;
using widgets::plot_number;

constexpr std::size_t max_named_values = 12;

QString with_unit(const QString& name, const std::string& unit) {
    return unit.empty() ? name : QStringLiteral("%1 (%2)").arg(name, text_of(unit));
}

const MetricDescription* known_metric(const std::string& name) {
    for (const auto& each : metrics())
        if (each.name == name) return &each;
    return nullptr;
}

QString metric_label(const std::string& name) {
    const auto* known = known_metric(name);
    return known ? text_of(known->label) : text_of(name);
}

double error_of(const ErrorPoint& point, const std::string& metric) {
    const auto found = point.errors.find(metric);
    return found == point.errors.end() ? std::nan("") : found->second;
}

widgets::PlotCell error_cell(const ErrorPoint& point, const std::string& metric) {
    const double error = error_of(point, metric);
    if (std::isnan(error)) return {QStringLiteral("—")};
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
                if (const auto text = value_text(point.value); !names_.contains(text)) names_ << text;
    }

    DrawnStudy draw() {
        data_.title = text_of(plot_.name.empty() ? plot_.id : plot_.name);
        draw_axes();
        data_.ring_name = QObject::tr("front: no other is faster and better");
        data_.join_rings = plot_.against_time;
        if (names_experiments()) data_.headings << QObject::tr("Experiment");
        data_.headings << over_.first << with_unit(metric_label(plot_.metric), unit_of(plot_.metric))
                       << QObject::tr("ms");
        for (const auto& metric : study_.metrics)
            if (metric != plot_.metric) data_.headings << with_unit(metric_label(metric), unit_of(metric));
        data_.headings << QObject::tr("Memory") << QObject::tr("Front");
        for (const auto& point : study_.points) draw_point(point);
        if (plot_.metric == "rmse" && study_.reference_noise > 0)
            data_.level = widgets::PlotLevel{study_.reference_noise, QObject::tr("reference's own noise")};
        for (const auto& note : study_.notes) data_.notes << text_of(note);
        return {std::move(data_), why_no_log_x_, why_no_log_y_};
    }

  private:
    static std::string unit_of(const std::string& metric) {
        const auto* known = known_metric(metric);
        return known ? known->unit : std::string();
    }

    bool names_experiments() const {
        const auto& points = study_.points;
        return plot_.experiments.size() > 1 ||
               std::any_of(points.begin(), points.end(), [&](const ErrorPoint& point) {
                   return point.experiment != points.front().experiment;
               });
    }

    /// What the values are called, and their unit.
    std::pair<QString, std::string> key_label() const {
        if (look_.over == "frames") return {QObject::tr("Frames"), ""};
        if (look_.over == "seed") return {QObject::tr("Seed"), ""};
        for (const auto& point : study_.points) {
            const auto* experiment = projects::find_item(project_.experiments, point.experiment);
            const auto* method = experiment ? registry_.find(experiment->method) : nullptr;
            const auto* parameter = method ? ir::find(method->parameters, look_.over) : nullptr;
            if (parameter) return {text_of(parameter->label), parameter->unit};
        }
        return {text_of(look_.over), ""};
    }

    double place_of(const ErrorPoint& point) const {
        if (plot_.against_time) return point.ms;
        if (!names_.isEmpty()) return double(names_.indexOf(value_text(point.value)));
        return point.value.get<double>();
    }

    void draw_axes() {
        auto& x = data_.x;
        const auto is_there = [](const ErrorPoint& point) { return point.problem.empty(); };
        if (plot_.against_time) {
            x.title = QObject::tr("Time of rendering (ms)");
        } else {
            x.title = with_unit(over_.first, over_.second);
            x.names = names_;
            if (!names_.isEmpty()) why_no_log_x_ = QObject::tr("The values are no numbers.");
            for (const auto& point : study_.points) {
                if (!names_.isEmpty() || !is_there(point)) continue;
                if (place_of(point) <= 0) why_no_log_x_ = QObject::tr("Not all values are above zero.");
                if (std::find(x.wanted.begin(), x.wanted.end(), place_of(point)) == x.wanted.end())
                    x.wanted.push_back(place_of(point));
            }
            if (x.wanted.size() > max_named_values) x.wanted.clear();
        }
        const auto* metric = known_metric(plot_.metric);
        data_.y.title = with_unit(metric_label(plot_.metric), unit_of(plot_.metric));
        if (metric && metric->best == Best::highest)
            why_no_log_y_ =
                QObject::tr("More is better in %1: it is drawn as it is.").arg(text_of(metric->label));
        for (const auto& point : study_.points)
            if (is_there(point) && error_of(point, plot_.metric) < 0)
                why_no_log_y_ = QObject::tr("Not all errors are above zero.");
        x.log = look_.log_x && why_no_log_x_.isEmpty();
        data_.y.log = look_.log_y && why_no_log_y_.isEmpty();
    }

    QString name_of(const std::string& experiment) const {
        const auto* found = projects::find_item(project_.experiments, experiment);
        return text_of(found && !found->name.empty() ? found->name : experiment);
    }

    widgets::PlotSeries& series_of(const std::string& experiment) {
        for (std::size_t i = 0; i < experiments_.size(); ++i)
            if (experiments_[i] == experiment) return data_.series[i];
        experiments_.push_back(experiment);
        data_.series.push_back({name_of(experiment), {}});
        return data_.series.back();
    }

    void draw_point(const ErrorPoint& point) {
        const auto value = value_text(point.value);
        if (!point.problem.empty()) {
            data_.problems << QObject::tr("%1, %2 = %3: %4")
                                  .arg(name_of(point.experiment), over_.first, value, text_of(point.problem));
            return;
        }
        widgets::PlotPoint drawn;
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
        drawn.cells.push_back({widgets::bytes_text(point.memory_bytes), double(point.memory_bytes)});
        drawn.cells.push_back({point.on_front ? QStringLiteral("●") : QString()});
        series_of(point.experiment).points.push_back(std::move(drawn));
    }

    QString label_of(const ErrorPoint& point) const {
        QStringList lines;
        lines << name_of(point.experiment);
        lines << QStringLiteral("%1 = %2").arg(over_.first, value_text(point.value));
        lines << QObject::tr("%1 ms").arg(plot_number(point.ms));
        const auto unit = unit_of(plot_.metric);
        lines << QStringLiteral("%1 %2%3").arg(
            metric_label(plot_.metric), plot_number(error_of(point, plot_.metric)),
            unit.empty() ? QString() : QStringLiteral(" ") + text_of(unit));
        lines << widgets::bytes_text(point.memory_bytes);
        if (point.on_front) lines << data_.ring_name;
        return lines.join(QLatin1Char('\n'));
    }

    const projects::Project& project_;
    const Registry& registry_;
    const projects::ErrorPlot& plot_;
    const ErrorStudy& study_;
    const PlotLook& look_;
    std::pair<QString, std::string> over_;
    QStringList names_;  ///< of values that are no numbers
    std::vector<std::string> experiments_;
    widgets::PlotData data_;
    QString why_no_log_x_, why_no_log_y_;
};

}  // namespace

QString value_text(const Json& value) {
    return value.is_string() ? text_of(value.get<std::string>())
           : value.is_null() ? QString()
                             : text_of(value.dump());
}

QString point_id(const ErrorPoint& point) {
    return QStringLiteral("%1=%2").arg(text_of(point.experiment), text_of(point.value.dump()));
}

const ErrorPoint* find_point(const ErrorStudy& study, const QString& id) {
    for (const auto& point : study.points)
        if (point_id(point) == id) return &point;
    return nullptr;
}

DrawnStudy draw_study(const projects::Project& project, const Registry& registry,
                      const projects::ErrorPlot& plot, ErrorStudy study, const PlotLook& look) {
    engine::mark_front(study.points, plot.metric);
    return Drawing(project, registry, plot, study, look).draw();
}

}  // namespace ir::gui
