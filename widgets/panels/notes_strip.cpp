#include "widgets/panels/notes_strip.h"

#include <QAbstractTextDocumentLayout>
#include <QHBoxLayout>
#include <QHelpEvent>
#include <QImage>
#include <QLabel>
#include <QResizeEvent>
#include <QStyle>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextCursor>
#include <QTextLayout>
#include <QToolButton>
#include <QToolTip>
#include <algorithm>
#include <cmath>

namespace ir::widgets {
namespace {

/// Of the first paragraph, which says what the views show. What follows scrolls: the pictures are what the
/// window is for.
constexpr int max_lines = 4;

const auto without_html =
    QTextDocument::MarkdownFeatures(QTextDocument::MarkdownDialectGitHub) | QTextDocument::MarkdownNoHTML;

/// As tooltips show it, whatever it looks like.
QString plain_tip(const QString& text) {
    return text.isEmpty() ? QString() : QStringLiteral("<p>%1</p>").arg(text.toHtmlEscaped());
}

/// Qt gives only the words before a heading's first link its size and weight.
void even_out_headings(QTextDocument& document) {
    for (auto block = document.begin(); block.isValid(); block = block.next()) {
        if (block.blockFormat().headingLevel() == 0 || block.length() <= 1) continue;
        QTextCharFormat heading;
        heading.setFontWeight(QFont::Bold);
        heading.setProperty(QTextFormat::FontSizeAdjustment, 4 - block.blockFormat().headingLevel());
        QTextCursor words(block);
        words.movePosition(QTextCursor::EndOfBlock, QTextCursor::KeepAnchor);
        words.mergeCharFormat(heading);
    }
}

/// Loads nothing, and tells where links lead and not what they say of themselves.
class NotesBrowser : public QTextBrowser {
  public:
    using QTextBrowser::QTextBrowser;

  protected:
    QVariant loadResource(int type, const QUrl&) override {
        if (type != QTextDocument::ImageResource) return {};
        QImage nothing(1, 1, QImage::Format_ARGB32);  // Qt reads the file itself where it gets none
        nothing.fill(Qt::transparent);
        return nothing;
    }
    bool viewportEvent(QEvent* event) override {
        if (event->type() != QEvent::ToolTip) return QTextBrowser::viewportEvent(event);
        const auto* help = static_cast<QHelpEvent*>(event);
        QToolTip::showText(help->globalPos(), plain_tip(anchorAt(help->pos())), viewport());
        return true;
    }
};

}  // namespace

NotesStrip::NotesStrip(QWidget* parent)
    : QWidget(parent), fold_(new QToolButton(this)), line_(new QLabel(this)), text_(new NotesBrowser(this)) {
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
    text_->setAccessibleName(fold_->accessibleName());
    text_->setOpenLinks(false);
    text_->setFrameShape(QFrame::NoFrame);
    text_->viewport()->setAutoFillBackground(false);
    text_->document()->setDocumentMargin(0);
    text_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    row->addWidget(text_, 1, Qt::AlignTop);
    connect(text_, &QTextBrowser::anchorClicked, this, &NotesStrip::link_chosen);
    connect(fold_, &QToolButton::clicked, this, [this] {
        set_folded(!folded_);
        emit folded_changed(folded_);
    });
    set_notes({});
}

void NotesStrip::set_notes(const QString& notes) {
    const auto trimmed = notes.trimmed();
    if (trimmed != notes_) {  // else it stays scrolled
        notes_ = trimmed;
        text_->document()->setMarkdown(notes_, without_html);
        even_out_headings(*text_->document());
        text_->moveCursor(QTextCursor::Start);  // else it scrolls to the end
    }
    setVisible(!notes_.isEmpty());
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
    text_->setVisible(!folded_);
    const auto margins = layout()->contentsMargins();
    const int room = std::max(
        40, width() - fold_->sizeHint().width() - layout()->spacing() - margins.left() - margins.right());
    const auto words = text_->toPlainText();
    line_->setText(fontMetrics().elidedText(words.simplified(), Qt::ElideRight, room));
    line_->setToolTip(plain_tip(words));
    text_->setFixedHeight(height_of_beginning(room));
}

/// Of the first paragraph and the headings above it, at most max_lines of it. Whatever is longer gets a
/// scroll bar.
int NotesStrip::height_of_beginning(int width) {
    auto& document = *text_->document();
    auto first = document.firstBlock();
    while (first.blockFormat().headingLevel() > 0 && first.next().isValid()) first = first.next();
    const auto lay_out = [&](int room) {
        document.setTextWidth(room);
        return document.documentLayout()->blockBoundingRect(first);
    };
    auto place = lay_out(width);
    const bool scrolls = first.next().isValid() || first.layout()->lineCount() > max_lines;
    text_->setVerticalScrollBarPolicy(scrolls ? Qt::ScrollBarAlwaysOn : Qt::ScrollBarAlwaysOff);
    if (scrolls) place = lay_out(width - style()->pixelMetric(QStyle::PM_ScrollBarExtent));
    const int lines = std::min(first.layout()->lineCount(), max_lines);
    if (lines == 0) return fontMetrics().lineSpacing();
    const auto last = first.layout()->lineAt(lines - 1);
    return int(std::ceil(place.top() + last.y() + last.height()));
}

}  // namespace ir::widgets
