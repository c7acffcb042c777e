#include "widgets/panels/empty_tree_view.h"

#include <QPainter>

namespace ir::widgets {

namespace {

void paint_text(QAbstractItemView& view, const QString& text) {
    QPainter painter(view.viewport());
    painter.setPen(view.palette().color(QPalette::PlaceholderText));
    painter.drawText(view.viewport()->rect().adjusted(12, 12, -12, -12), Qt::AlignCenter | Qt::TextWordWrap,
                     text);
}

}  // namespace

void paint_empty_text(QAbstractItemView& view, const QString& text) {
    if (!view.model() || view.model()->rowCount() == 0) paint_text(view, text);
}

EmptyTreeView::EmptyTreeView(const QString& empty_text, QWidget* parent)
    : QTreeView(parent), empty_text_(empty_text) {}

void EmptyTreeView::set_empty_text(const QString& text) {
    if (text == empty_text_) return;
    empty_text_ = text;
    viewport()->update();
}

void EmptyTreeView::paintEvent(QPaintEvent* event) {
    QTreeView::paintEvent(event);
    if (!is_any_shown()) paint_text(*this, empty_text_);
}

bool EmptyTreeView::is_any_shown() const {
    for (int i = 0; model() && i < model()->rowCount(); ++i)
        if (!isRowHidden(i, {})) return true;
    return false;
}

}  // namespace ir::widgets
