#include "widgets/panels/sample_card.h"

#include <QGuiApplication>
#include <QKeyEvent>
#include <QPainter>
#include <QTextLayout>

#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

constexpr int card_margin = 6, note_lines = 3;

int height_of_picture(int width) {
    return (width - 2 * card_margin) * 9 / 16;
}

}  // namespace

int draw_lines(QPainter& painter, const QRect& box, const QString& text, int most) {
    QTextLayout layout(text, painter.font());
    layout.beginLayout();
    const QFontMetrics metrics = painter.fontMetrics();
    int y = box.top();
    int number = 0;
    for (; number < most; ++number) {
        QTextLine line = layout.createLine();
        if (!line.isValid()) break;
        line.setLineWidth(box.width());
        QString part = text.mid(line.textStart(), line.textLength());
        if (number == most - 1 && line.textStart() + line.textLength() < text.size())
            part = metrics.elidedText(text.mid(line.textStart()), Qt::ElideRight, box.width());
        painter.drawText(QPoint(box.left(), y + metrics.ascent()), part);
        y += metrics.lineSpacing();
    }
    layout.endLayout();
    return number;
}

void draw_project_picture(QPainter& painter, const QRect& box, const QImage& picture, bool enabled) {
    painter.fillRect(box, QGuiApplication::palette().color(QPalette::Dark));
    if (picture.isNull()) {
        const int side = 28;
        QRect place(0, 0, side, side);
        place.moveCenter(box.center());
        painter.setOpacity(enabled ? 0.5 : 0.25);
        widgets::icon("open").paint(&painter, place);
        painter.setOpacity(1);
        return;
    }
    const QSizeF whole = picture.size();
    QRectF part(QPointF(), QSizeF(box.size()).scaled(whole, Qt::KeepAspectRatio));
    part.moveCenter(QRectF(QPointF(), whole).center());
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.drawImage(box, picture, part);
}

SampleCard::SampleCard(const Content& content, QWidget* parent) : QAbstractButton(parent), content_(content) {
    setText(content.name);
    setAccessibleName(content.name);
    setAccessibleDescription(content.note);
    setFocusPolicy(Qt::StrongFocus);
    setCursor(Qt::PointingHandCursor);
    setAttribute(Qt::WA_Hover);
    QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    policy.setHeightForWidth(true);
    setSizePolicy(policy);
}

int SampleCard::heightForWidth(int width) const {
    return height_of_picture(width) + (2 + note_lines) * fontMetrics().lineSpacing() + 3 * card_margin;
}

void SampleCard::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const bool lit = underMouse() || hasFocus();
    painter.setPen(hasFocus() ? QPen(palette().color(QPalette::Highlight), 2) : QPen(Qt::NoPen));
    painter.setBrush(palette().color(isDown() ? QPalette::Mid : lit ? QPalette::Midlight : QPalette::Window));
    painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 4, 4);
    const QRect picture(card_margin, card_margin, width() - 2 * card_margin, height_of_picture(width()));
    draw_project_picture(painter, picture, content_.picture, isEnabled());
    QRect text(card_margin + 2, picture.bottom() + card_margin, width() - 2 * card_margin - 4, height());
    QFont bold = font();
    bold.setBold(true);
    painter.setFont(bold);
    painter.setPen(palette().color(QPalette::WindowText));
    text.translate(0, draw_lines(painter, text, content_.name, 2) * painter.fontMetrics().lineSpacing());
    painter.setFont(font());
    painter.setPen(palette().color(QPalette::PlaceholderText).lighter(125));
    const int room = (height() - card_margin - text.top()) / fontMetrics().lineSpacing();
    draw_lines(painter, text, content_.note, room);
    if (content_.time.isEmpty()) return;
    QRect plate(0, 0, fontMetrics().horizontalAdvance(content_.time) + 10, fontMetrics().height() + 2);
    plate.moveBottomRight(picture.bottomRight() - QPoint(4, 4));
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(20, 20, 20, 190));
    painter.drawRoundedRect(plate, 3, 3);
    painter.setPen(QColor(235, 235, 235));
    painter.drawText(plate, Qt::AlignCenter, content_.time);
}

void SampleCard::keyPressEvent(QKeyEvent* event) {
    const bool enter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    enter ? click() : QAbstractButton::keyPressEvent(event);
}

bool SampleCard::event(QEvent* event) {
    const auto type = event->type();
    if (type == QEvent::HoverEnter || type == QEvent::HoverLeave) update();
    return QAbstractButton::event(event);
}

}  // namespace ir::widgets
