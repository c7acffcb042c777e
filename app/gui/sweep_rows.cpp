#include "app/gui/sweep_rows.h"

#include <QObject>
#include <algorithm>
#include <optional>

#include "app/engine/study_plot.h"
#include "app/gui/text_of.h"
#include "renderers/image/metrics.h"
#include "renderers/plot/plot_scale.h"

namespace ir::gui {
namespace {

using engine::SweepRow;
using widgets::SweepCell, widgets::SweepLine;

/// Ids of plots: against the time, an axis, or two of them by their numbers.
const std::string over_time = "time", over_axis = "over:", over_two = "heat:";

SweepCell number_cell(std::optional<double> value) {
    return value ? SweepCell{text_of(plot_number(*value)), value} : SweepCell{};
}

SweepCell value_cell(const projects::Json& value) {
    return {text_of(engine::value_text(value)),
            value.is_number() ? std::optional(value.get<double>()) : std::nullopt};
}

SweepLine::State state_of(const SweepRow& row, bool is_stale, bool is_running) {
    using State = SweepLine::State;
    if (row.is_done()) return is_stale ? State::stale : State::done;
    if (is_running) return State::running;
    return row.has_failed() ? State::failed : State::waiting;
}

bool has_option(const std::vector<widgets::Option>& options, const std::string& id) {
    return std::any_of(options.begin(), options.end(),
                       [&](const widgets::Option& each) { return each.id == text_of(id); });
}

}  // namespace

SweepColumns sweep_columns(const engine::SweepTable& table) {
    return {engine::axes_of(table), engine::quantities_of(table)};
}

widgets::SweepRows sweep_headings(const SweepColumns& columns) {
    widgets::SweepRows rows;
    for (const auto& axis : columns.axes) {
        rows.headings << text_of(axis);
        rows.docs << QObject::tr("What varies");
    }
    rows.axes = int(columns.axes.size());
    for (const auto& quantity : columns.quantities) {
        const auto& names = metric_names();
        const bool is_metric = std::find(names.begin(), names.end(), quantity.key) != names.end();
        rows.headings << text_of(quantity.heading);
        rows.docs << text_of(is_metric ? metric(quantity.key).doc : quantity.heading);
    }
    return rows;
}

SweepLine sweep_line(const engine::SweepSheet& sheet, const SweepColumns& columns, std::size_t index,
                     const std::filesystem::path& folder, bool is_running) {
    const auto& row = sheet.table.rows[index];
    SweepLine line;
    line.id = text_of(row.id);
    line.name = text_of(engine::name_of(row));
    line.state = state_of(row, index < sheet.stale.size() && sheet.stale[index], is_running);
    if (line.state == SweepLine::State::failed) line.problem = text_of(row.problem);
    for (const auto& axis : columns.axes)
        line.cells.push_back(value_cell(row.coordinates.value(axis, projects::Json())));
    for (const auto& quantity : columns.quantities)
        line.cells.push_back(number_cell(engine::value_of(row, quantity.key)));
    const auto picture = engine::picture_of(row, folder);
    if (row.is_done() && picture.empty() && !row.image.empty())
        line.problem = QObject::tr("The list names a picture elsewhere, which is not shown.");
    if (!row.is_done() || picture.empty()) return line;
    line.picture = text_of(picture.string());
    line.reference = text_of(engine::reference_of(row, folder).string());
    line.version = text_of(row.key + " " + std::to_string(row.cold_ms));
    return line;
}

void fill_sweep_plot(widgets::SweepFields& fields, const engine::SweepTable& table,
                     const SweepColumns& columns, const SweepPlotChoice& choice) {
    const auto& axes = columns.axes;
    fields.plots.push_back({text_of(over_time), QObject::tr("Over time"), {}});
    for (const auto& axis : engine::number_axes_of(table))
        fields.plots.push_back({text_of(over_axis + axis), QObject::tr("Over %1").arg(text_of(axis)), {}});
    for (std::size_t a = 0; a < axes.size(); ++a)
        for (std::size_t b = a + 1; b < axes.size(); ++b)
            fields.plots.push_back({text_of(over_two + std::to_string(a) + ":" + std::to_string(b)),
                                    QStringLiteral("%1 × %2").arg(text_of(axes[a]), text_of(axes[b])),
                                    QObject::tr("Colours at each pair of values")});
    fields.plot = text_of(has_option(fields.plots, choice.plot) ? choice.plot : over_time);
    for (const auto& quantity : columns.quantities)
        fields.quantities.push_back({text_of(quantity.key), text_of(quantity.heading), {}});
    const std::string usual = has_option(fields.quantities, "rmse") ? "rmse"
                              : columns.quantities.empty()          ? std::string()
                                                                    : columns.quantities.back().key;
    fields.quantity = text_of(has_option(fields.quantities, choice.quantity) ? choice.quantity : usual);
}

void draw_sweep_plot(widgets::SweepFields& fields, const engine::SweepTable& table) {
    const auto plot = fields.plot.toStdString(), quantity = fields.quantity.toStdString();
    const auto& rows = table.rows;
    if (std::none_of(rows.begin(), rows.end(), [](const SweepRow& row) { return row.is_done(); })) {
        fields.why_no_plot = QObject::tr("Points appear as variations are rendered.");
    } else if (plot.starts_with(over_two)) {
        const auto axes = engine::axes_of(table);
        const auto numbers = fields.plot.mid(int(over_two.size())).split(QLatin1Char(':'));
        fields.data = engine::sweep_heat(table, axes.at(numbers.value(0).toUInt()),
                                         axes.at(numbers.value(1).toUInt()), quantity);
    } else {
        fields.data =
            engine::sweep_plot(table, plot == over_time ? "" : plot.substr(over_axis.size()), quantity);
    }
}

}  // namespace ir::gui
