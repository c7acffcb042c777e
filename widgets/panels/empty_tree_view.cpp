#include "widgets/panels/empty_tree_view.h"

#include <QPainter>

namespace ir::widgets {

void paint_empty_text(QAbstractItemView& view, const QString& text) {
    if (view.model() && view.model()->rowCount() > 0) return;
    QPainter painter(view.viewport());
    painter.setPen(view.palette().color(QPalette::PlaceholderText));
    painter.drawText(view.viewport()->rect().adjusted(12, 12, -12, -12), Qt::AlignCenter | Qt::TextWordWrap,
                     text);
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
    paint_empty_text(*this, empty_text_);
}

}  // namespace ir::widgets
