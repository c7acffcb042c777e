#include <QKeyEvent>

#include "widgets/compare/compare_view.h"

/// Keys of a comparison, and what it hears of its panes.
namespace ir::widgets {
namespace {

/// The picture that a key stands for; -1: none.
int picture_of_key(const QKeyEvent& event) {
    const bool plain = !(event.modifiers() & ~Qt::KeyboardModifiers(Qt::KeypadModifier));
    return plain && event.key() >= Qt::Key_1 && event.key() <= Qt::Key_9 ? event.key() - Qt::Key_1 : -1;
}

}  // namespace

bool CompareView::may_hold() const {
    return count() >= 2 && mode_ != Mode::side_by_side && mode_ != Mode::stages;
}

void CompareView::hold(int picture) {
    if (picture == held_) return;
    held_ = picture;
    refresh();
}

void CompareView::keyPressEvent(QKeyEvent* event) {
    if (const int picture = picture_of_key(*event); picture >= 0 && picture < count() && may_hold()) {
        if (!event->isAutoRepeat()) hold(picture);
        return;
    }
    if (choose_by_key(*event)) return;
    if (event->modifiers() == Qt::NoModifier && event->key() == Qt::Key_X && count() >= 2) return swap();
    if (event->modifiers() == Qt::NoModifier && event->key() == Qt::Key_L) return set_linked(!is_linked());
    QWidget::keyPressEvent(event);
}

void CompareView::keyReleaseEvent(QKeyEvent* event) {
    if (event->isAutoRepeat()) return;
    if (held_ >= 0 && event->key() == Qt::Key_1 + held_) return hold(-1);
    QWidget::keyReleaseEvent(event);
}

bool CompareView::eventFilter(QObject* watched, QEvent* event) {
    if (watched == board_) {
        if (event->type() == QEvent::Resize) place();
        if (event->type() == QEvent::Paint) {
            paint_board();
            return true;
        }
        return on_board_event(event) || QWidget::eventFilter(watched, event);
    }
    switch (event->type()) {
        case QEvent::ShortcutOverride:  // a held number is no shortcut of the window while it shows a picture
            if (const int picture = picture_of_key(*static_cast<QKeyEvent*>(event));
                picture >= 0 && picture < count() && may_hold())
                event->accept();
            if (choose_by_key(*static_cast<QKeyEvent*>(event))) event->accept();
            break;
        case QEvent::KeyPress: {
            const auto& key = *static_cast<QKeyEvent*>(event);
            if (mode_ == Mode::flip && key.key() == Qt::Key_Tab && key.modifiers() == Qt::NoModifier &&
                count() >= 2) {
                flip_next();
                return true;
            }
            break;
        }
        case QEvent::FocusOut:  // the release of a held key goes elsewhere
            hold(-1);
            break;
        default:
            break;
    }
    return QWidget::eventFilter(watched, event);
}

}  // namespace ir::widgets
