#include "widgets/panels/cards.h"

#include <QKeyEvent>
#include <QPainter>
#include <QTextLayout>
#include <algorithm>

#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

constexpr int picture_width = 84, picture_height = 56, margin = 7;  // of projects
constexpr int card_margin = 6, max_note_lines = 3, sign_side = 28;  // of samples

int height_of_picture(int width) {
    return (width - 2 * card_margin) * 9 / 16;
}

/// Draws at most `max_lines` lines from the top of the box, the last one elided. Returns how many.
int draw_lines(QPainter& painter, const QRect& box, const QString& text, int max_lines) {
    QTextLayout layout(text, painter.font());
    layout.beginLayout();
    const QFontMetrics metrics = painter.fontMetrics();
    int y = box.top();
    int number = 0;
    for (; number < max_lines; ++number) {
        QTextLine line = layout.createLine();
        if (!line.isValid()) break;
        line.setLineWidth(box.width());
        QString part = text.mid(line.textStart(), line.textLength());
        if (number == max_lines - 1 && line.textStart() + line.textLength() < text.size())
            part = metrics.elidedText(text.mid(line.textStart()), Qt::ElideRight, box.width());
        painter.drawText(QPoint(box.left(), y + metrics.ascent()), part);
        y += metrics.lineSpacing();
    }
    layout.endLayout();
    return number;
}

}  // namespace

Card::Card(const Content& content, QWidget* parent) : QAbstractButton(parent), content_(content) {
    setText(content.name);
    setAccessibleName(content.name);
    setAccessibleDescription(content.note);
    setFocusPolicy(Qt::StrongFocus);
    setCursor(Qt::PointingHandCursor);
    setAttribute(Qt::WA_Hover);
}

void Card::paint_ground(QPainter& painter) const {
    painter.setRenderHint(QPainter::Antialiasing);
    const bool lit = isEnabled() && (underMouse() || hasFocus());
    painter.setPen(hasFocus() ? QPen(palette().color(QPalette::Highlight), 2) : QPen(Qt::NoPen));
    painter.setBrush(palette().color(isDown() ? QPalette::Mid : lit ? QPalette::Midlight : QPalette::Window));
    painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 4, 4);
}

/// The middle of the picture, or without one a sign for it.
void Card::paint_picture(QPainter& painter, const QRect& box) const {
    painter.fillRect(box, palette().color(QPalette::Dark));
    const auto& picture = content_.picture;
    if (picture.isNull()) {
        QRect place(0, 0, sign_side, sign_side);
        place.moveCenter(box.center());
        painter.setOpacity(isEnabled() ? 0.5 : 0.25);
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

void Card::set_name_pen(QPainter& painter) const {
    QFont bold = font();
    bold.setBold(true);
    painter.setFont(bold);
    painter.setPen(palette().color(QPalette::WindowText));
}

void Card::set_note_pen(QPainter& painter) const {
    painter.setFont(font());
    painter.setPen(isEnabled() ? theme_colours().dim : palette().color(QPalette::PlaceholderText));
}

void Card::keyPressEvent(QKeyEvent* event) {
    const bool enter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    enter ? click() : QAbstractButton::keyPressEvent(event);
}

bool Card::event(QEvent* event) {
    const auto type = event->type();
    if (type == QEvent::HoverEnter || type == QEvent::HoverLeave) update();
    return QAbstractButton::event(event);
}

ProjectCard::ProjectCard(const Content& content, QWidget* parent) : Card(content, parent) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

QSize ProjectCard::sizeHint() const {
    const int text = fontMetrics().lineSpacing() * (2 + note_lines()) + 4;
    return {300, std::max(picture_height, text) + 2 * margin};
}

int ProjectCard::note_lines() const {
    return content().note.isEmpty() ? 0 : content().detail.isEmpty() ? max_note_lines : 1;
}

void ProjectCard::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    paint_ground(painter);
    const QRect picture(margin, margin, picture_width, picture_height);
    paint_picture(painter, picture);
    QRect text = rect().adjusted(picture.right() + 1 + margin + 3, margin, -margin, -margin);
    set_name_pen(painter);
    painter.drawText(text, Qt::AlignLeft | Qt::AlignTop,
                     painter.fontMetrics().elidedText(content().name, Qt::ElideRight, text.width()));
    set_note_pen(painter);
    text.setTop(text.top() + fontMetrics().lineSpacing() + 2);
    if (!content().note.isEmpty()) draw_lines(painter, text, content().note, note_lines());
    if (content().detail.isEmpty()) return;
    text.setTop(text.top() + note_lines() * fontMetrics().lineSpacing());
    painter.drawText(text, Qt::AlignLeft | Qt::AlignTop,
                     fontMetrics().elidedText(content().detail, Qt::ElideMiddle, text.width()));
}

SampleCard::SampleCard(const Content& content, QWidget* parent) : Card(content, parent) {
    QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    policy.setHeightForWidth(true);
    setSizePolicy(policy);
}

int SampleCard::heightForWidth(int width) const {
    return height_of_picture(width) + (2 + max_note_lines) * fontMetrics().lineSpacing() + 3 * card_margin;
}

void SampleCard::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    paint_ground(painter);
    const QRect picture(card_margin, card_margin, width() - 2 * card_margin, height_of_picture(width()));
    paint_picture(painter, picture);
    QRect text(card_margin + 2, picture.bottom() + card_margin, width() - 2 * card_margin - 4, height());
    set_name_pen(painter);
    text.translate(0, draw_lines(painter, text, content().name, 2) * painter.fontMetrics().lineSpacing());
    set_note_pen(painter);
    const int room = (height() - card_margin - text.top()) / fontMetrics().lineSpacing();
    draw_lines(painter, text, content().note, room);
    const auto& time = content().detail;
    if (time.isEmpty()) return;
    QRect plate(0, 0, fontMetrics().horizontalAdvance(time) + 10, fontMetrics().height() + 2);
    plate.moveBottomRight(picture.bottomRight() - QPoint(4, 4));
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(20, 20, 20, 190));
    painter.drawRoundedRect(plate, 3, 3);
    painter.setPen(QColor(235, 235, 235));
    painter.drawText(plate, Qt::AlignCenter, time);
}

CardFlow::CardFlow(int card_width, QWidget* parent) : QLayout(parent), card_width_(card_width) {
    setContentsMargins(0, 0, 0, 0);
    setSpacing(8);
}

CardFlow::~CardFlow() {
    for (auto* item : items_) delete item;
}

QLayoutItem* CardFlow::itemAt(int index) const {
    return index >= 0 && index < count() ? items_[std::size_t(index)] : nullptr;
}

QLayoutItem* CardFlow::takeAt(int index) {
    auto* item = itemAt(index);
    if (item) items_.erase(items_.begin() + index);
    return item;
}

QSize CardFlow::minimumSize() const {
    QSize size;
    for (const auto* item : items_)
        if (!item->isEmpty()) size = size.expandedTo(item->minimumSize());
    return size;
}

void CardFlow::setGeometry(const QRect& rect) {
    QLayout::setGeometry(rect);
    place(rect, true);
}

int CardFlow::place(const QRect& rect, bool apply) const {
    const int columns = std::max(1, (rect.width() + spacing()) / (card_width_ + spacing()));
    const int width = (rect.width() - (columns - 1) * spacing()) / columns;
    int number = 0, top = rect.top(), row_height = 0;
    for (auto* item : items_) {
        if (item->isEmpty()) continue;
        if (number > 0 && number % columns == 0) {
            top += row_height + spacing();
            row_height = 0;
        }
        const int height =
            item->hasHeightForWidth() ? item->heightForWidth(width) : item->sizeHint().height();
        row_height = std::max(row_height, height);
        if (apply)
            item->setGeometry(
                QRect(rect.left() + number % columns * (width + spacing()), top, width, height));
        ++number;
    }
    return top + row_height - rect.top();
}

}  // namespace ir::widgets
