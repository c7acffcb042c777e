#include "widgets/pipeline/pixel_changes.h"

#include <QCoreApplication>
#include <map>

#include "widgets/style/number_text.h"

namespace ir::widgets {
namespace {

QString change_text(const char* text) {
    return QCoreApplication::translate("PixelChanges", text);
}

QString values_text(const std::vector<float>& values) {
    constexpr int digits = 4;
    QStringList numbers;
    for (const float value : values) numbers << number_text(value, digits);
    return numbers.join(QStringLiteral("  "));
}

}  // namespace

QStringList change_headings() {
    return {change_text("Pass"), change_text("Buffer"), change_text("Before"), change_text("After")};
}

std::vector<Row> change_rows(const FrameReport& report) {
    std::map<std::string, const std::vector<float>*> known;
    std::vector<Row> rows;
    for (const auto& change : report.pixel_changes) {
        const auto*& before = known[change.key];
        const auto* resource = find_resource(report, change.key);
        const auto label = resource && !resource->label.empty() ? resource->label : change.key;
        Row row{std::to_string(rows.size()) + ":" + change.key, {}};
        row.dim = before && *before == change.values;
        row.cells = {{QString::fromStdString(change.pass)},
                     {QString::fromStdString(label), QString::fromStdString(change.key)},
                     {before ? values_text(*before) : QStringLiteral("–"),
                      before ? QString() : change_text("No pass has written it before in this frame.")},
                     {values_text(change.values)}};
        before = &change.values;
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace ir::widgets
