#include "widgets/panels/notes_strip.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QResizeEvent>
#include <QScrollArea>
#include <QToolButton>
#include <algorithm>

namespace ir::widgets {
namespace {

/// Of the first paragraph, which says what the views show. What follows scrolls: the pictures are what the
/// window is for.
constexpr int max_lines = 4;

}  // namespace

NotesStrip::NotesStrip(QWidget* parent)
    : QWidget(parent),
      fold_(new QToolButton(this)),
      line_(new QLabel(this)),
      text_(new QLabel),
      scroll_(new QScrollArea(this)) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(4, 3, 8, 3);
    row->setSpacing(6);
    fold_->setObjectName(QStringLiteral("fold-notes"));
    fold_->setAutoRaise(true);
    fold_->setAccessibleName(tr("Notes of the project"));
    row->addWidget(fold_, 0, Qt::AlignTop);
    line_->setTextFormat(Qt::PlainText);
    line_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    row->addWidget(line_, 1);
    text_->setTextFormat(Qt::PlainText);
    text_->setWordWrap(true);
    text_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    text_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    scroll_->setWidget(text_);
    scroll_->setWidgetResizable(true);
    scroll_->setFrameShape(QFrame::NoFrame);
    scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    row->addWidget(scroll_, 1);
    connect(fold_, &QToolButton::clicked, this, [this] {
        set_folded(!folded_);
        emit folded_changed(folded_);
    });
    set_notes({});
}

void NotesStrip::set_notes(const QString& notes) {
    notes_ = notes.trimmed();
    setVisible(!notes_.isEmpty());
    text_->setText(notes_);
    update_text();
}

void NotesStrip::set_folded(bool folded) {
    folded_ = folded;
    update_text();
}

void NotesStrip::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    update_text();
}

void NotesStrip::update_text() {
    fold_->setArrowType(folded_ ? Qt::RightArrow : Qt::DownArrow);
    fold_->setToolTip(folded_ ? tr("Show the notes of the project") : tr("Fold the notes into one line"));
    line_->setVisible(folded_);
    scroll_->setVisible(!folded_);
    const int room = std::max(40, width() - fold_->sizeHint().width() - 22);
    line_->setText(fontMetrics().elidedText(notes_.simplified(), Qt::ElideRight, room));
    line_->setToolTip(notes_);
    const auto first = notes_.section(QLatin1Char('\n'), 0, 0);
    const int line = fontMetrics().lineSpacing();
    const int needed = fontMetrics().boundingRect(QRect(0, 0, room, 0), Qt::TextWordWrap, first).height();
    scroll_->setFixedHeight(std::clamp((needed + line - 1) / line, 1, max_lines) * line);
}

}  // namespace ir::widgets
