#include "widgets/panels/search_list.h"

#include <QHelpEvent>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QScreen>
#include <QScrollBar>
#include <QStandardItemModel>
#include <QToolTip>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/panels/controls.h"
#include "widgets/style/icons.h"
#include "widgets/style/rich_text.h"

namespace ir::widgets {
namespace {

constexpr int min_width = 260, max_width = 460, max_height = 460;  // logical pixels

QString tip_of(const SearchEntry& entry) {
    QStringList lines;
    if (!entry.key.isEmpty()) lines << QStringLiteral("<b>%1</b>").arg(entry.key.toHtmlEscaped());
    if (!entry.doc.isEmpty()) lines << entry.doc.toHtmlEscaped().replace('\n', QStringLiteral("<br>"));
    return lines.join(QStringLiteral("<br>"));
}

bool is_heading(const QModelIndex& row) {
    return !row.flags().testFlag(Qt::ItemIsEnabled);
}

/// Set by us alone: a click on its box is a click on the row.
void tick(QStandardItem& row, const SearchEntry& entry) {
    if (entry.is_chosen) row.setData(*entry.is_chosen ? Qt::Checked : Qt::Unchecked, Qt::CheckStateRole);
}

}  // namespace

SearchList::SearchList(QWidget* parent)
    : QFrame(parent, Qt::Popup),
      model_(new QStandardItemModel(this)),
      line_(new QLineEdit(this)),
      nothing_(new QLabel(this)),
      list_(new QListView(this)) {
    setFrameShape(QFrame::StyledPanel);
    setAttribute(Qt::WA_NoMouseReplay);  // a click on what opened this closes it, and does not open it anew
    line_->setPlaceholderText(tr("Search"));
    line_->setAccessibleName(line_->placeholderText());
    line_->setClearButtonEnabled(true);
    line_->installEventFilter(this);
    nothing_->setWordWrap(true);
    nothing_->setMargin(4);
    list_->setModel(model_);
    list_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    list_->setFrameShape(QFrame::NoFrame);
    list_->setFocusPolicy(Qt::NoFocus);
    list_->setAccessibleName(tr("What fits"));
    list_->viewport()->installEventFilter(this);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(2, 2, 2, 2);
    column->setSpacing(2);
    column->addWidget(line_);
    column->addWidget(nothing_);
    column->addWidget(list_);
    connect(line_, &QLineEdit::textChanged, this, &SearchList::search);
    connect(line_, &QLineEdit::returnPressed, this, [this] { choose(list_->currentIndex()); });
    connect(list_, &QListView::clicked, this, &SearchList::choose);
}

void SearchList::set_entries(const std::vector<SearchEntry>& entries) {
    if (entries == entries_) return;
    const bool is_same_list =
        std::ranges::equal(entries, entries_, [](SearchEntry now, const SearchEntry& before) {
            now.is_chosen = before.is_chosen;
            return now == before;
        });
    entries_ = entries;
    if (!is_same_list) return fill();
    for (int i = 0; i < model_->rowCount(); ++i)  // in place: one goes on choosing
        if (auto* row = model_->item(i); row->isEnabled())
            tick(*row, entries_[std::size_t(row->data(place_role).toInt())]);
}

void SearchList::fill() {
    model_->removeRows(0, model_->rowCount());
    QString group;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        const auto& entry = entries_[i];
        if (entry.group != group) {
            group = entry.group;
            auto* heading = new QStandardItem(group);
            heading->setEnabled(false);
            model_->appendRow(heading);
        }
        auto* row = new QStandardItem(entry.label.isEmpty() ? entry.key : entry.label);
        if (entry.sign) row->setIcon(icon(entry.sign));
        row->setData(entry.key, key_role);
        row->setData(int(i), place_role);
        row->setToolTip(tip_of(entry));
        tick(*row, entry);
        model_->appendRow(row);
    }
    if (isVisible()) search(line_->text());
}

void SearchList::open_at(const QWidget& control, int row) {
    line_->clear();
    search({});
    list_->setCurrentIndex(model_->index(row, 0));
    const QRect room = control.screen()->availableGeometry();
    const int bar = list_->verticalScrollBar()->sizeHint().width() + 8;
    const int height = std::max(list_->sizeHintForRow(0), list_->sizeHintForRow(model_->rowCount() - 1)) *
                           (model_->rowCount() + 1) +
                       line_->sizeHint().height() + 8;
    QSize size(std::clamp(list_->sizeHintForColumn(0) + bar, std::max(min_width, control.width()),
                          std::max(max_width, control.width())),
               std::min(max_height, height));
    if (entries_.empty()) size = sizeHint();
    QPoint place = control.mapToGlobal(control.rect().bottomLeft());
    if (place.y() + size.height() > room.bottom())
        place.ry() = std::max(room.top(), control.mapToGlobal(QPoint()).y() - size.height());
    place.rx() = std::clamp(place.x(), room.left(), std::max(room.left(), room.right() - size.width()));
    setGeometry(QRect(place, size));
    show();
    list_->scrollTo(list_->currentIndex());
    line_->setFocus(Qt::PopupFocusReason);
}

void SearchList::search(const QString& query) {
    int best = -1;
    for (const auto letters : {Letters::all, Letters::some})
        if (best < 0) best = show_fitting(query, letters);
    nothing_->setText(entries_.empty() ? empty_text_ : nothing_fits());
    nothing_->setVisible(best < 0);
    line_->setVisible(!entries_.empty());
    list_->setVisible(!entries_.empty());
    list_->setCurrentIndex(model_->index(best, 0));
}

/// The row that fits best; -1: none does.
int SearchList::show_fitting(const QString& query, Letters letters) {
    int heading = -1, best = -1, most = 0;
    for (int i = 0; i < model_->rowCount(); ++i) {
        const auto row = model_->index(i, 0);
        if (is_heading(row)) heading = i;
        const int fit =
            is_heading(row)
                ? 0
                : fit_of(query, row.data().toString(),
                         {model_->index(heading, 0).data().toString(), row.data(key_role).toString()},
                         letters);
        list_->setRowHidden(i, fit == 0);
        if (fit > 0 && heading >= 0) list_->setRowHidden(heading, false);
        if (fit > most) {
            most = fit;
            best = i;
        }
    }
    return best;
}

void SearchList::choose(const QModelIndex& row) {
    if (!row.isValid() || is_heading(row)) return;
    if (row.data(Qt::CheckStateRole).isValid())
        line_->selectAll();  // the next word takes its place
    else
        hide();
    emit chosen(row);
}

void SearchList::show_tip(const QHelpEvent& event) const {
    const auto row = list_->indexAt(event.pos());
    const auto picture = pictures_ && row.isValid() && !is_heading(row) ? pictures_(row) : QImage();
    QToolTip::showText(event.globalPos(), picture_text(picture) + row.data(Qt::ToolTipRole).toString(),
                       list_->viewport(), list_->visualRect(row));
}

bool SearchList::eventFilter(QObject* watched, QEvent* event) {
    if (watched == line_ && moves_through(list_, event)) return true;
    if (watched == list_->viewport() && event->type() == QEvent::ToolTip) {
        show_tip(*static_cast<QHelpEvent*>(event));
        return true;
    }
    return QFrame::eventFilter(watched, event);
}

}  // namespace ir::widgets
