#include "widgets/panels/manual_window.h"

#include <QAction>
#include <QDesktopServices>
#include <QDir>
#include <QImage>
#include <QRegularExpression>
#include <QScrollBar>
#include <QStyle>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextTable>
#include <QToolBar>
#include <QVBoxLayout>
#include <algorithm>

namespace ir::widgets {
namespace {

/// Without those that are code.
QStringList lines_of(const QString& file) {
    QFile text(file);
    if (!text.open(QIODevice::ReadOnly)) return {};
    QStringList lines;
    bool in_code = false;
    for (const auto& line : QString::fromUtf8(text.readAll()).split(QLatin1Char('\n'))) {
        if (line.startsWith(QLatin1String("```"))) in_code = !in_code;
        if (!in_code) lines << line;
    }
    return lines;
}

ManualPage page_of(const QString& file, const QString& place) {
    ManualPage page{file, QFileInfo(file).completeBaseName(), place, {}};
    QStringList headings;
    for (const auto& line : lines_of(file)) {
        if (line.startsWith(QLatin1String("# "))) page.title = line.sliced(2);
        if (line.startsWith(QLatin1String("## "))) headings << line.sliced(3);
    }
    page.headings = headings.join(QLatin1Char('\n'));
    return page;
}

/// As GitHub names headings.
QString name_of(const QString& heading) {
    QString name;
    for (const QChar letter : heading.toLower())
        if (letter.isLetterOrNumber() || letter == QLatin1Char('-') || letter == QLatin1Char('_'))
            name += letter;
        else if (letter == QLatin1Char(' '))
            name += QLatin1Char('-');
    return name;
}

/// `key` or `key=value` as code within the block, selected; null: it is not named there.
QTextCursor named_in(const QTextBlock& block, const QString& key) {
    if (block.blockFormat().hasProperty(QTextFormat::BlockCodeFence)) return {};
    for (auto part = block.begin(); !part.atEnd(); ++part) {
        const auto fragment = part.fragment();
        if (!fragment.charFormat().fontFixedPitch()) continue;
        if (fragment.text() != key && !fragment.text().startsWith(key + QLatin1Char('='))) continue;
        QTextCursor cursor(block);
        cursor.setPosition(fragment.position());
        cursor.setPosition(fragment.position() + int(key.size()), QTextCursor::KeepAnchor);
        return cursor;
    }
    return {};
}

/// Pictures are no wider than the window.
class Browser : public QTextBrowser {
  public:
    using QTextBrowser::QTextBrowser;

  protected:
    QVariant loadResource(int type, const QUrl& name) override {
        const auto loaded = QTextBrowser::loadResource(type, name);
        if (type != QTextDocument::ImageResource) return loaded;
        constexpr int beside = 64;  // logical pixels: margins and the scroll bar
        const int room = std::max(beside, window()->width() - beside);
        auto picture = QImage::fromData(loaded.toByteArray());
        if (picture.width() <= room) return loaded;
        // Scaled with a palette, it would be dithered.
        picture.convertTo(QImage::Format_ARGB32_Premultiplied);
        const int width = std::min(picture.width(), int(room * devicePixelRatioF()));
        picture = picture.scaledToWidth(width, Qt::SmoothTransformation);
        picture.setDevicePixelRatio(double(width) / room);
        return picture;
    }
};

}  // namespace

QString page_with(const QStringList& files, const QString& key) {
    const QRegularExpression named(QStringLiteral("`%1(=[^`]*)?`").arg(QRegularExpression::escape(key)));
    QString first;
    for (const auto& file : files)
        for (const auto& line : lines_of(file)) {
            const auto match = named.match(line);
            if (!match.hasMatch()) continue;
            const bool is_row = line.startsWith(QLatin1Char('|')) &&
                                match.capturedStart() < line.indexOf(QLatin1Char('|'), 1);
            if (is_row) return file;
            if (first.isEmpty()) first = file;
        }
    return first;
}

std::vector<ManualPage> manual_pages(const QString& folder) {
    std::vector<ManualPage> pages;
    const auto add = [&](const QString& place) {
        const QDir files(place.isEmpty() ? folder : folder + QLatin1Char('/') + place);
        for (const auto& name : files.entryList({QStringLiteral("*.md")}, QDir::Files, QDir::Name)) {
            const bool is_first = name == QLatin1String("README.md");
            pages.insert(is_first ? pages.begin() : pages.end(), page_of(files.filePath(name), place));
        }
    };
    for (const char* place : {"docs", "docs/methods", ""}) add(QLatin1String(place));
    return pages;
}

ManualWindow::ManualWindow(QWidget* parent) : QWidget(parent, Qt::Window), browser_(new Browser(this)) {
    setWindowTitle(tr("Manual"));
    setObjectName(QStringLiteral("manual"));
    resize(860, 760);
    auto* bar = new QToolBar(this);
    const auto add = [&](QStyle::StandardPixmap drawing, const QString& text, QKeySequence::StandardKey key,
                         auto slot) {
        auto* action = bar->addAction(style()->standardIcon(drawing), text, browser_, slot);
        action->setShortcuts(key);
        return action;
    };
    auto* back = add(QStyle::SP_ArrowBack, tr("Back"), QKeySequence::Back, &QTextBrowser::backward);
    auto* forward =
        add(QStyle::SP_ArrowForward, tr("Forward"), QKeySequence::Forward, &QTextBrowser::forward);
    for (auto* action : {back, forward}) action->setEnabled(false);
    connect(browser_, &QTextBrowser::backwardAvailable, back, &QAction::setEnabled);
    connect(browser_, &QTextBrowser::forwardAvailable, forward, &QAction::setEnabled);
    browser_->setOpenLinks(false);
    browser_->setFrameShape(QFrame::NoFrame);
    browser_->document()->setDocumentMargin(16);
    connect(browser_, &QTextBrowser::anchorClicked, this, &ManualWindow::follow);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(bar);
    layout->addWidget(browser_);
}

void ManualWindow::show_page(const QString& file, const QString& key) {
    follow(QUrl::fromLocalFile(file));
    show();
    raise();
    activateWindow();
    if (!key.isEmpty()) go_to_key(key);
}

bool ManualWindow::go_to_key(const QString& key) {
    QTextCursor first;
    for (auto block = browser_->document()->begin(); block.isValid(); block = block.next()) {
        const auto named = named_in(block, key);
        if (named.isNull()) continue;
        const auto* table = named.currentTable();
        const bool is_row = table && table->cellAt(named).column() == 0;
        if (first.isNull() || is_row) first = named;
        if (is_row) break;
    }
    if (first.isNull()) {
        browser_->setTextCursor(QTextCursor(browser_->document()));
        browser_->verticalScrollBar()->setValue(0);
        return false;
    }
    browser_->setTextCursor(QTextCursor(browser_->document()->lastBlock()));
    browser_->setTextCursor(first);  // at the top now; what stands above it is seen, too
    auto* bar = browser_->verticalScrollBar();
    bar->setValue(bar->value() - browser_->viewport()->height() / 3);
    return true;
}

QUrl ManualWindow::page() const {
    return browser_->source();
}

void ManualWindow::follow(const QUrl& link) {
    const auto target = browser_->source().resolved(link);
    if (!target.isLocalFile() || !target.path().endsWith(QLatin1String(".md"))) {
        QDesktopServices::openUrl(target);
        return;
    }
    const auto page = target.adjusted(QUrl::RemoveFragment);
    if (page != browser_->source()) browser_->setSource(page, QTextDocument::MarkdownResource);
    setWindowTitle(tr("%1 – Manual").arg(page_of(page.toLocalFile(), {}).title));
    if (target.hasFragment()) go_to_heading(target.fragment());
}

void ManualWindow::go_to_heading(const QString& name) {
    for (auto block = browser_->document()->begin(); block.isValid(); block = block.next()) {
        if (block.blockFormat().headingLevel() == 0 || name_of(block.text()) != name) continue;
        browser_->setTextCursor(QTextCursor(browser_->document()->lastBlock()));
        browser_->setTextCursor(QTextCursor(block));  // so that it stands at the top
        return;
    }
}

}  // namespace ir::widgets
