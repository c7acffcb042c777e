#include "widgets/metrics/metrics_text.h"

#include <QCoreApplication>
#include <QLocale>
#include <algorithm>
#include <cmath>

#include "renderers/core/words.h"
#include "widgets/metrics/metrics_model.h"

namespace ir::widgets {
namespace {

QString translated(const char* text) {
    return QCoreApplication::translate("Metrics", text);
}

QString number(const MetricResult& result, const std::string& metric) {
    const auto found = result.values.find(metric);
    if (found == result.values.end()) return {};
    if (std::isnan(found->second)) return QStringLiteral("nan");
    if (std::isinf(found->second)) return found->second > 0 ? QStringLiteral("inf") : QStringLiteral("-inf");
    return QString::number(found->second, 'g', QLocale::FloatingPointShortest);
}

QString shown(const MetricResult& result, const MetricDescription& metric) {
    const auto found = result.values.find(metric.name);
    return found == result.values.end() ? QString() : metric_text(metric, found->second);
}

}  // namespace

QString pixels_text(const MetricResult& result) {
    QString text =
        translated(result.pixels == 1 ? "%1 pixel compared" : "%1 pixels compared").arg(result.pixels);
    if (result.skipped) text += translated(", %1 skipped").arg(result.skipped);
    return text;
}

QString as_text(const MetricsResult& result) {
    const auto& request = result.request;
    QString text =
        translated("A  %1\nB  %2 (reference)\n").arg(request.image->label, request.reference->label);
    if (request.mask) text += translated("Mask  %1\n").arg(request.mask->label);
    const QRect& r = request.rectangle;
    text += translated("Image: %1\n").arg(pixels_text(result.image));
    if (result.rectangle)
        text += translated("Rectangle x %1 y %2, %3×%4: %5\n")
                    .arg(r.x())
                    .arg(r.y())
                    .arg(r.width())
                    .arg(r.height())
                    .arg(pixels_text(*result.rectangle));
    for (const auto& metric : metrics()) {
        text += QString::fromStdString(metric.label).leftJustified(16) +
                shown(result.image, metric).rightJustified(12);
        if (result.rectangle) text += shown(*result.rectangle, metric).rightJustified(12);
        text += QLatin1Char('\n');
    }
    return text;
}

QString as_csv(const std::vector<const MetricsResult*>& results) {
    if (results.empty()) return {};
    const bool are_several = results.size() > 1;
    const bool has_rectangle = std::any_of(results.begin(), results.end(),
                                           [](const auto* each) { return each->rectangle.has_value(); });
    QString text = are_several ? QStringLiteral("a,b,metric,image") : QStringLiteral("metric,image");
    text += has_rectangle ? QStringLiteral(",rectangle\n") : QStringLiteral("\n");
    for (const auto* result : results) {
        const auto& request = result->request;
        const auto field = [](const QString& label) {
            return QString::fromStdString(csv_field(label.toStdString())) + QLatin1Char(',');
        };
        const QString pair =
            are_several ? field(request.image->label) + field(request.reference->label) : QString();
        const auto line = [&](const QString& name, const QString& image, const QString& rectangle) {
            text += pair + name + QLatin1Char(',') + image;
            if (has_rectangle) text += QLatin1Char(',') + rectangle;
            text += QLatin1Char('\n');
        };
        for (const auto& metric : metrics())
            line(QString::fromStdString(metric.name), number(result->image, metric.name),
                 result->rectangle ? number(*result->rectangle, metric.name) : QString());
        const MetricResult none;
        const MetricResult& rectangle = result->rectangle ? *result->rectangle : none;
        line(QStringLiteral("pixels"), QString::number(result->image.pixels),
             QString::number(rectangle.pixels));
        line(QStringLiteral("skipped"), QString::number(result->image.skipped),
             QString::number(rectangle.skipped));
    }
    return text;
}

}  // namespace ir::widgets
