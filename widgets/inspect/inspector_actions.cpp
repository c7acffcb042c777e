#include <QApplication>
#include <QClipboard>
#include <QKeyEvent>
#include <QMenu>
#include <QTreeView>

#include "widgets/inspect/inspector_panel.h"

/// What clicks, keys and menus of the inspector do.
namespace ir::widgets {

void InspectorPanel::clicked(const QModelIndex& at) {
    if (at.column() != InspectorModel::cursor_column || at.data(InspectorModel::available_role).toBool())
        return;
    const QString key = at.data(InspectorModel::buffer_role).toString();
    model_->mark_wanted(key);
    emit compute_wanted(key);
}

void InspectorPanel::activated(const QModelIndex& at) {
    const QString key = at.data(InspectorModel::buffer_role).toString();
    if (!key.isEmpty()) return void(emit show_wanted(key));
    const QModelIndex row = at.siblingAtColumn(0);
    if (filter_->hasChildren(row)) view_->setExpanded(row, !view_->isExpanded(row));
}

void InspectorPanel::add_column_actions(QMenu& menu, int column) {
    const auto pixel = model_->place_of(column);
    if (!pixel) return;
    menu.addAction(tr("Explain pixel %1, %2").arg(pixel->x()).arg(pixel->y()), this,
                   [this, at = *pixel] { emit explain_wanted(at); });
    const int pin = column - InspectorModel::first_pin_column;
    if (pin < 0) {
        menu.addAction(tr("Pin this pixel"), this, [this, at = *pixel] { emit pin_wanted(at); });
    } else {
        menu.addAction(tr("Fly to pin %1").arg(pin + 1), this, [this, pin] { emit fly_wanted(pin); });
        menu.addAction(tr("Remove pin %1").arg(pin + 1), this, [this, pin] { emit pin_removed(pin); });
    }
}

void InspectorPanel::show_column_menu(int column, QPoint at) {
    auto* menu = new QMenu(this);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    add_column_actions(*menu, column);
    if (!model_->pins().empty()) menu->addAction(tr("Remove all pins"), this, &InspectorPanel::pins_cleared);
    menu->isEmpty() ? menu->deleteLater() : menu->popup(at);
}

void InspectorPanel::show_menu(QPoint at) {
    const QModelIndex index = view_->indexAt(at);
    auto* menu = new QMenu(this);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    const QString key = index.data(InspectorModel::buffer_role).toString();
    if (!key.isEmpty()) {
        if (index.data(InspectorModel::available_role).toBool())
            menu->addAction(tr("Show in the active view"), this, [this, key] { emit show_wanted(key); });
        else
            menu->addAction(tr("Have it computed"), this,
                            [this, index] { clicked(index.siblingAtColumn(InspectorModel::cursor_column)); });
    }
    const QString value = index.data(InspectorModel::full_role).toString();
    if (!value.isEmpty())
        menu->addAction(tr("Copy %1").arg(value.size() > 40 ? tr("value") : value), this,
                        [value] { QApplication::clipboard()->setText(value); });
    if (!menu->isEmpty()) menu->addSeparator();
    add_column_actions(*menu, index.isValid() ? index.column() : int(InspectorModel::cursor_column));
    menu->addSeparator();
    menu->addAction(tr("Copy all as text"), this, &InspectorPanel::copy_text);
    menu->addAction(tr("Copy all as CSV"), this, &InspectorPanel::copy_csv);
    menu->popup(view_->viewport()->mapToGlobal(at));
}

void InspectorPanel::pin_cursor() {
    if (model_->readings().cursor) emit pin_wanted(*model_->readings().cursor);
}

void InspectorPanel::copy_text() {
    QApplication::clipboard()->setText(text());
}

void InspectorPanel::copy_csv() {
    QApplication::clipboard()->setText(csv());
}

void InspectorPanel::copy_selection() {
    QModelIndexList rows = view_->selectionModel()->selectedRows();
    if (rows.isEmpty()) return copy_text();
    QStringList lines;
    for (const QModelIndex& row : rows) {
        QStringList cells{row.data().toString()};
        for (int c = InspectorModel::cursor_column; c < filter_->columnCount(); ++c)
            cells << row.siblingAtColumn(c).data(InspectorModel::full_role).toString();
        lines << cells.join(QLatin1Char('\t'));
    }
    QApplication::clipboard()->setText(lines.join(QLatin1Char('\n')));
}

bool InspectorPanel::eventFilter(QObject* watched, QEvent* event) {
    if (watched == view_->viewport()) {
        if (event->type() == QEvent::Resize) fit_columns();
        if (event->type() == QEvent::MouseMove) point_at(static_cast<QMouseEvent*>(event)->pos());
        return false;
    }
    if (event->type() != QEvent::KeyPress) return false;
    const auto* key = static_cast<QKeyEvent*>(event);
    if (key->matches(QKeySequence::Copy)) return copy_selection(), true;
    const int pin = view_->currentIndex().column() - InspectorModel::first_pin_column;
    if (key->key() != Qt::Key_Delete || pin < 0) return false;
    emit pin_removed(pin);
    return true;
}

}  // namespace ir::widgets
