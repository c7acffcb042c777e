#include <QAbstractTextDocumentLayout>
#include <QKeyEvent>
#include <algorithm>

#include "widgets/document/fields.h"

namespace ir::widgets {
namespace {

constexpr int min_lines = 5, max_lines = 30;  ///< as high as the text in between
constexpr int pause_ms = 500;                 ///< of typing, after which notes are taken over

bool is_undo_key(QEvent* event) {
    if (event->type() != QEvent::ShortcutOverride) return false;
    const auto* key = static_cast<QKeyEvent*>(event);
    return key->matches(QKeySequence::Undo) || key->matches(QKeySequence::Redo);
}

}  // namespace

TextField::TextField(const char* name, QWidget* parent) : QLineEdit(parent) {
    setObjectName(QLatin1String(name));
    connect(this, &QLineEdit::editingFinished, this, &TextField::commit);
}

void TextField::show_text(const QString& text) {
    if (text == shown_ && isModified() && hasFocus()) return;  // something newer is being typed
    shown_ = text;
    refused_.clear();
    if (text != this->text()) setText(text);
    setModified(false);
}

void TextField::keep_refused(const QString& text) {
    setText(text);
    setModified(true);
    refused_ = text;
}

void TextField::commit() {
    if (!isModified() || (!refused_.isEmpty() && text() == refused_)) return;
    setModified(false);
    if (text().trimmed() != shown_) emit chosen(text().trimmed());
}

bool TextField::event(QEvent* event) {
    // Nothing typed: undo and redo belong to the document.
    if (is_undo_key(event) && !isModified()) {
        event->ignore();
        return true;
    }
    return QLineEdit::event(event);
}

void TextField::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape && isModified()) return setText(shown_);
    QLineEdit::keyPressEvent(event);
}

NotesField::NotesField(const char* name, QWidget* parent) : QPlainTextEdit(parent) {
    setObjectName(QLatin1String(name));
    setTabChangesFocus(true);
    const auto fit = [this] {
        const int lines = std::clamp(int(document()->size().height()), min_lines, max_lines);
        setFixedHeight(fontMetrics().lineSpacing() * lines + 12);
    };
    connect(document()->documentLayout(), &QAbstractTextDocumentLayout::documentSizeChanged, this, fit);
    fit();
    pause_.setSingleShot(true);
    pause_.setInterval(pause_ms);
    connect(&pause_, &QTimer::timeout, this, &NotesField::commit);
    connect(this, &QPlainTextEdit::textChanged, this, [this] {
        if (document()->isModified()) pause_.start();
    });
}

void NotesField::show_text(const QString& text) {
    if (pause_.isActive()) return;  // something newer is being typed
    shown_ = text;
    if (text == toPlainText()) return;
    setPlainText(text);
    document()->setModified(false);
}

void NotesField::commit() {
    pause_.stop();
    document()->setModified(false);
    const QString text = toPlainText();
    if (text == shown_) return;
    shown_ = text;
    emit chosen(text);
}

void NotesField::discard() {
    pause_.stop();
    setPlainText(shown_);
    document()->setModified(false);
}

bool NotesField::event(QEvent* event) {
    if (is_undo_key(event) && !document()->isModified()) {
        event->ignore();
        return true;
    }
    return QPlainTextEdit::event(event);
}

void NotesField::focusOutEvent(QFocusEvent* event) {
    QPlainTextEdit::focusOutEvent(event);
    commit();
    emit finished();
}

}  // namespace ir::widgets
