#include "widgets/panels/project_card.h"

#include <QKeyEvent>
#include <QPainter>
#include <algorithm>

#include "widgets/panels/sample_card.h"

namespace ir::widgets {
namespace {

constexpr int picture_width = 84, picture_height = 56, margin = 7;

}  // namespace

ProjectCard::ProjectCard(const Content& content, QWidget* parent)
    : QAbstractButton(parent), content_(content) {
    setText(content.name);
    setAccessibleName(content.name);
    setAccessibleDescription(content.note);
    setFocusPolicy(Qt::StrongFocus);
    setCursor(Qt::PointingHandCursor);
    setAttribute(Qt::WA_Hover);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

QSize ProjectCard::sizeHint() const {
    const int text = fontMetrics().lineSpacing() * (2 + note_lines()) + 4;
    return {300, std::max(picture_height, text) + 2 * margin};
}

int ProjectCard::note_lines() const {
    return content_.note.isEmpty() ? 0 : content_.detail.isEmpty() ? 3 : 1;
}

void ProjectCard::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const bool lit = isEnabled() && (underMouse() || hasFocus());
    painter.setPen(hasFocus() ? QPen(palette().color(QPalette::Highlight), 2) : QPen(Qt::NoPen));
    painter.setBrush(palette().color(isDown() ? QPalette::Mid : lit ? QPalette::Midlight : QPalette::Window));
    painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 4, 4);
    const QRect picture(margin, margin, picture_width, picture_height);
    draw_project_picture(painter, picture, content_.thumbnail, isEnabled());

    QRect text = rect().adjusted(picture.right() + 1 + margin + 3, margin, -margin, -margin);
    QFont bold = font();
    bold.setBold(true);
    painter.setFont(bold);
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(text, Qt::AlignLeft | Qt::AlignTop,
                     painter.fontMetrics().elidedText(content_.name, Qt::ElideRight, text.width()));
    painter.setFont(font());
    painter.setPen(palette().color(QPalette::PlaceholderText).lighter(isEnabled() ? 125 : 100));
    text.setTop(text.top() + fontMetrics().lineSpacing() + 2);
    if (!content_.note.isEmpty()) draw_lines(painter, text, content_.note, note_lines());
    if (content_.detail.isEmpty()) return;
    text.setTop(text.top() + note_lines() * fontMetrics().lineSpacing());
    painter.drawText(text, Qt::AlignLeft | Qt::AlignTop,
                     fontMetrics().elidedText(content_.detail, Qt::ElideMiddle, text.width()));
}

void ProjectCard::keyPressEvent(QKeyEvent* event) {
    const bool enter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    enter ? click() : QAbstractButton::keyPressEvent(event);
}

bool ProjectCard::event(QEvent* event) {
    const auto type = event->type();
    if (type == QEvent::HoverEnter || type == QEvent::HoverLeave) update();
    return QAbstractButton::event(event);
}

}  // namespace ir::widgets
