#include "widgets/panels/empty_tree_view.h"

#include <QPainter>

namespace ir::widgets {

EmptyTreeView::EmptyTreeView(const QString& empty_text, QWidget* parent)
    : QTreeView(parent), empty_text_(empty_text) {}

void EmptyTreeView::set_empty_text(const QString& text) {
    if (text == empty_text_) return;
    empty_text_ = text;
    viewport()->update();
}

void EmptyTreeView::paintEvent(QPaintEvent* event) {
    QTreeView::paintEvent(event);
    if (model() && model()->rowCount() > 0) return;
    QPainter painter(viewport());
    painter.setPen(palette().color(QPalette::PlaceholderText));
    painter.drawText(viewport()->rect().adjusted(12, 12, -12, -12), Qt::AlignCenter | Qt::TextWordWrap,
                     empty_text_);
}

}  // namespace ir::widgets
