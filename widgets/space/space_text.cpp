#include <QCoreApplication>
#include <algorithm>

#include "widgets/space/space_overlay.h"

namespace ir::widgets {
namespace {

QString noun(OutputKind kind) {
    switch (kind) {
        case OutputKind::point_set:
            return QStringLiteral("points");
        case OutputKind::line_set:
            return QStringLiteral("lines");
        case OutputKind::glyphs:
            return QStringLiteral("glyphs");
        case OutputKind::sphere_values:
            return QStringLiteral("directions");
        default:
            return QStringLiteral("elements");
    }
}

QString ordinal(std::uint64_t n) {
    const bool teen = n % 100 >= 11 && n % 100 <= 13;
    const char* ending = teen ? "th" : n % 10 == 1 ? "st" : n % 10 == 2 ? "nd" : n % 10 == 3 ? "rd" : "th";
    return QString::number(n) + QLatin1String(ending);
}

}  // namespace

QString count_text(std::uint64_t count) {
    if (count < 10'000) return QString::number(count);
    const auto scaled = [&](double unit, const char* letter) {
        const double value = double(count) / unit;
        return QString::number(value, 'f', value < 100 ? 1 : 0) + QLatin1Char(' ') + QLatin1String(letter);
    };
    return count < 1'000'000 ? scaled(1e3, "k") : count < 1'000'000'000 ? scaled(1e6, "M") : scaled(1e9, "G");
}

QString amount_text(OutputKind kind, std::uint64_t elements, std::uint64_t stride) {
    auto word = noun(kind);
    if (elements == 1) word.chop(1);
    const QString all = count_text(elements) + QLatin1Char(' ') + word;
    return stride <= 1 ? all : QStringLiteral("every %1 of %2").arg(ordinal(stride), all);
}

QString amount_text(const LayerInfo& info) {
    const QString all = amount_text(info.requested.kind, info.elements, info.stride);
    if (info.requested.filters.empty() || !info.passing) return all;
    return QStringLiteral("%1 of %2").arg(count_text(*info.passing), all);
}

QString colour_text(const SpaceLayer& layer, const std::vector<Field>& fields) {
    if (layer.colour_by.empty()) return QStringLiteral("one colour");
    if (layer.colour_by == SpaceLayer::facing) return QStringLiteral("facing");
    const QString name = QString::fromStdString(layer.colour_by);
    const Field* field = find_field(fields, layer.colour_by);
    if (!field || field->count < 2) return name;
    return QStringLiteral("%1, %2").arg(name, component_name(layer.kind, *field, layer.component));
}

QString element_text(const SpaceScene& scene, const std::vector<LayerInfo>& drawn,
                     const std::vector<SpaceSelector>& selectors, const SpaceElement& element,
                     const QString& values) {
    if (element.layer < 0 || std::size_t(element.layer) >= scene.layers.size()) return {};
    const SpaceLayer& layer = scene.layers[std::size_t(element.layer)];
    const auto tr = [](const char* text) { return QCoreApplication::translate("SpaceView", text); };
    QString text = tr("%1 · element %2").arg(QString::fromStdString(layer.label)).arg(element.element);
    if (!values.isEmpty()) text += QLatin1Char('\n') + values;
    const auto info = std::find_if(drawn.begin(), drawn.end(),
                                   [&](const LayerInfo& each) { return each.key == layer.key; });
    if (info == drawn.end()) return text;
    for (const SpaceSelector& selector : selectors)
        for (const Field& field : info->fields)
            if (field.name == selector.key && field.type != FieldType::f32 && field.count == 1)
                text += QLatin1Char('\n') +
                        tr("click: show its %1").arg(QString::fromStdString(selector.label).toLower());
    return text;
}

QString component_name(OutputKind kind, const Field& field, int component) {
    // Of regions of a sphere [scene_3d.h].
    if (kind == OutputKind::sphere_values && field.count == 2)
        return component == 0 ? QStringLiteral("lower bound") : QStringLiteral("upper bound");
    return field.count <= 4 ? QString(QLatin1Char("xyzw"[component])) : QString::number(component);
}

}  // namespace ir::widgets
