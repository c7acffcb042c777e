#include "widgets/parameters/row_state.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <map>

#include "widgets/style/rich_text.h"

namespace ir::widgets {
namespace {

QString row_text(const char* text) {
    return QCoreApplication::translate("Parameters", text);
}

QString range_text(const Range& range) {
    const bool low = std::isfinite(range.min), high = std::isfinite(range.max);
    if (low && high) return row_text("%1 … %2").arg(number_text(range.min), number_text(range.max));
    if (low) return row_text("at least %1").arg(number_text(range.min));
    if (high) return row_text("at most %1").arg(number_text(range.max));
    return {};
}

const Value& value_of(const ParameterDescription& parameter, const Settings& settings) {
    const auto found = settings.find(parameter.key);
    return found == settings.end() ? parameter.default_value : found->second;
}

/// Methods hold numbers in single precision, so what differs only beyond it is no change.
bool is_same(const Value& a, const Value& b) {
    const auto *x = std::get_if<double>(&a), *y = std::get_if<double>(&b);
    return x && y ? static_cast<float>(*x) == static_cast<float>(*y) : a == b;
}

/// "Only active when Paths is Indirect light or Full."
QString why_inactive(const ParameterDescription& parameter, const std::vector<ParameterDescription>& all) {
    const auto* other = find(all, parameter.active_when.key);
    QStringList values;
    for (const auto& value : parameter.active_when.values)
        values << (other ? value_text(*other, value) : QString::fromStdString(to_string(value)));
    const QString label =
        other ? QString::fromStdString(other->label) : QString::fromStdString(parameter.active_when.key);
    return row_text("Has no effect now: it is used when “%1” is %2.")
        .arg(label, values.join(row_text(" or ")));
}

QString tooltip_of(const ParameterDescription& parameter) {
    QString text =
        QStringLiteral("<p><b>%1</b></p><p>%2</p><p>").arg(escaped(parameter.label), escaped(parameter.doc));
    text += row_text("Key: %1").arg(escaped(parameter.key));
    text += row_text("<br>Default: %1").arg(value_text(parameter, parameter.default_value).toHtmlEscaped());
    const QString range = range_text(parameter.hard);
    if (!range.isEmpty()) text += row_text("<br>Allowed: %1").arg(range);
    if (parameter.effect == Effect::cost) text += row_text("<br>Changes the cost, not the picture");
    if (!parameter.citation.empty()) text += row_text("<br>Source: %1").arg(escaped(parameter.citation));
    return text + QStringLiteral("</p>");
}

/// " texel" behind 1, " texels" behind all else.
QString unit_behind(double value, const std::string& unit) {
    static const std::map<std::string, const char*> of_one{
        {"degrees", "degree"}, {"frames", "frame"}, {"pixels", "pixel"},
        {"quanta", "quantum"}, {"radii", "radius"}, {"surfels per pixel", "surfel per pixel"},
        {"texels", "texel"}};
    if (unit.empty()) return {};
    const auto found = value == 1 ? of_one.find(unit) : of_one.end();
    return QLatin1Char(' ') + QString::fromStdString(found == of_one.end() ? unit : found->second);
}

constexpr std::size_t longest_suffix = 12;  ///< bytes; "W/(m² sr)" fits

}  // namespace

QString label_text(const ParameterDescription& parameter) {
    auto text = parameter.label;
    if (parameter.unit.size() > longest_suffix) text += " (" + parameter.unit + ")";
    return QString::fromStdString(text);
}

QString suffix_text(const ParameterDescription& parameter, double value) {
    return parameter.unit.size() > longest_suffix ? QString() : unit_behind(value, parameter.unit);
}

QString value_text(const ParameterDescription& parameter, const Value& value) {
    if (const auto* flag = std::get_if<bool>(&value)) return *flag ? row_text("on") : row_text("off");
    if (const auto* key = std::get_if<std::string>(&value)) {
        for (const auto& choice : parameter.choices)
            if (choice.key == *key) return QString::fromStdString(choice.label);
        return QString::fromStdString(*key);
    }
    const auto* real = std::get_if<double>(&value);
    const double number = real ? *real : double(std::get<std::int64_t>(value));
    const QString text = real ? number_text(*real) : QString::number(std::get<std::int64_t>(value));
    return text + unit_behind(number, parameter.unit);
}

RowState row_state(const ParameterDescription& parameter, const std::vector<ParameterDescription>& all,
                   const Settings& settings) {
    RowState state;
    state.enabled = is_active(parameter, settings);
    state.changed = !is_same(value_of(parameter, settings), parameter.default_value);
    state.tooltip = tooltip_of(parameter);
    if (!state.enabled)
        state.tooltip = QStringLiteral("<p><i>%1</i></p>").arg(why_inactive(parameter, all).toHtmlEscaped()) +
                        state.tooltip;
    return state;
}

Range slider_range(const ParameterDescription& parameter) {
    Range range{std::max(parameter.soft.min, parameter.hard.min),
                std::min(parameter.soft.max, parameter.hard.max)};
    if (!std::isfinite(range.min) || !std::isfinite(range.max) || range.min >= range.max) return {0, 0};
    return range;
}

bool is_logarithmic(const Range& range) {
    return range.min > 0 && range.max / range.min >= 100;
}

double slider_position(const Range& range, double value) {
    const double clamped = std::clamp(value, range.min, range.max);
    if (is_logarithmic(range)) return std::log(clamped / range.min) / std::log(range.max / range.min);
    return (clamped - range.min) / (range.max - range.min);
}

double slider_value(const Range& range, double position) {
    if (is_logarithmic(range)) return range.min * std::pow(range.max / range.min, position);
    return range.min + (range.max - range.min) * position;
}

}  // namespace ir::widgets
