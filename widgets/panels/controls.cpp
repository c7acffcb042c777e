#include "widgets/panels/controls.h"

#include <QComboBox>
#include <QItemSelectionModel>
#include <QLabel>
#include <QStringList>

namespace ir::widgets {

QString tip_with(const QString& tip, const QString& why_not) {
    return why_not.isEmpty() ? tip : QStringLiteral("%1.\n%2").arg(tip, why_not);
}

QLabel* make_cut_label(const char* name) {
    auto* label = new QLabel;
    label->setObjectName(QLatin1String(name));
    label->setTextFormat(Qt::PlainText);
    label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    label->setMinimumWidth(1);
    return label;
}

void show_options(QComboBox* list, const std::vector<Option>& options, const QString& current) {
    bool same = list->count() == int(options.size());
    for (std::size_t i = 0; same && i < options.size(); ++i)
        same = list->itemData(int(i)).toString() == options[i].id &&
               list->itemText(int(i)) == options[i].label &&
               list->itemData(int(i), Qt::ToolTipRole).toString() == options[i].tooltip;
    if (!same) {
        list->clear();
        for (const auto& option : options) {
            list->addItem(option.label, option.id);
            list->setItemData(list->count() - 1, option.tooltip, Qt::ToolTipRole);
        }
    }
    list->setCurrentIndex(list->findData(current));
}

QString rows_as_text(const QAbstractItemModel& model, const QItemSelectionModel& selection) {
    QStringList headings;
    for (int c = 0; c < model.columnCount(); ++c) headings << model.headerData(c, Qt::Horizontal).toString();
    QStringList lines{headings.join(QLatin1Char('\t'))};
    for (int row = 0; row < model.rowCount(); ++row) {
        if (selection.hasSelection() && !selection.isRowSelected(row, {})) continue;
        QStringList cells;
        for (int c = 0; c < model.columnCount(); ++c) cells << model.index(row, c).data().toString();
        lines << cells.join(QLatin1Char('\t'));
    }
    return lines.join(QLatin1Char('\n'));
}

}  // namespace ir::widgets
