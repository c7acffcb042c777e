#include "widgets/panels/finder_dialog.h"

#include <QEvent>
#include <QHeaderView>
#include <QHelpEvent>
#include <QLabel>
#include <QLineEdit>
#include <QTextDocument>
#include <QTimer>
#include <QToolTip>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/models/word_search.h"
#include "widgets/panels/controls.h"
#include "widgets/style/rich_text.h"

namespace ir::widgets {
namespace {

constexpr int usual_width = 780, usual_height = 420;  // logical pixels
constexpr int column_margin = 14, icon_size = 16;
constexpr std::size_t max_shown = 200;
enum Column { kind, name, place, keys };

}  // namespace

std::vector<std::size_t> found(const QString& query, const std::vector<Findable>& all) {
    std::vector<int> fits(all.size());
    std::vector<std::size_t> order;
    for (const auto letters : {Letters::all, Letters::some}) {
        if (!order.empty()) break;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const auto& what = all[i];
            fits[i] = fit_of(query, what.name, {what.also, what.kind, what.place}, letters);
            if (fits[i] > 0) order.push_back(i);
        }
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return fits[a] > fits[b]; });
    return order;
}

FinderDialog::FinderDialog(std::vector<Findable> all, const QString& what, QWidget* parent)
    : QDialog(parent, Qt::Dialog | Qt::FramelessWindowHint), all_(std::move(all)) {
    setWindowTitle(tr("Find"));
    setObjectName(QStringLiteral("finder"));
    auto* layout = new QVBoxLayout(this);
    line_ = new QLineEdit(this);
    line_->setPlaceholderText(what);
    line_->setAccessibleName(tr("Words to find"));
    line_->installEventFilter(this);
    list_ = new QTreeWidget(this);
    list_->setColumnCount(4);
    list_->setHeaderHidden(true);
    list_->setRootIsDecorated(false);
    list_->setUniformRowHeights(true);
    list_->setIconSize(QSize(icon_size, icon_size));
    list_->setFocusPolicy(Qt::NoFocus);
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    list_->setAccessibleName(tr("What fits"));
    list_->header()->setStretchLastSection(false);
    list_->header()->setSectionResizeMode(QHeaderView::Fixed);
    list_->header()->setMinimumSectionSize(0);
    list_->viewport()->installEventFilter(this);
    nothing_ = new QLabel(nothing_fits(), this);
    layout->addWidget(line_);
    layout->addWidget(nothing_);
    layout->addWidget(list_, 1);
    connect(line_, &QLineEdit::textChanged, this, &FinderDialog::search);
    connect(line_, &QLineEdit::returnPressed, this, &FinderDialog::go);
    connect(list_, &QTreeWidget::itemClicked, this, &FinderDialog::go);
    search({});
    const QSize room = parent->size();
    resize(std::min(usual_width, room.width() - 20), std::min(usual_height, room.height() - 20));
    move(parent->mapToGlobal(
        QPoint((room.width() - size().width()) / 2, std::min(80, (room.height() - size().height()) / 2))));
    line_->setFocus();
}

void FinderDialog::search(const QString& query) {
    list_->clear();
    const auto order = found(query, all_);
    QPixmap no_icon(icon_size, icon_size);  // so that words stand below each other
    no_icon.fill(Qt::transparent);
    for (std::size_t i = 0; i < std::min(max_shown, order.size()); ++i) {
        const auto& what = all_[order[i]];
        const bool is_open = what.why_not.isEmpty();
        auto* item = new QTreeWidgetItem(list_, {what.kind, what.name, what.place, what.keys});
        item->setData(kind, Qt::UserRole, QVariant::fromValue(qulonglong(order[i])));
        item->setIcon(kind, what.icon.isNull() ? QIcon(no_icon) : what.icon);
        item->setForeground(kind, palette().color(QPalette::PlaceholderText));
        item->setForeground(place, palette().color(QPalette::PlaceholderText));
        item->setTextAlignment(keys, Qt::AlignRight | Qt::AlignVCenter);
        if (is_open) continue;
        item->setForeground(name, palette().color(QPalette::PlaceholderText));
        item->setText(place, what.why_not);
    }
    nothing_->setVisible(order.empty());
    fit_columns();
    list_->setCurrentItem(list_->topLevelItem(0));
}

/// Names have the room that they need, places what is left of it: those are cut first.
void FinderDialog::fit_columns() {
    const auto needed = [this](int column) {
        int width = 0;
        for (int i = 0; i < list_->topLevelItemCount(); ++i)
            width =
                std::max(width, list_->fontMetrics().horizontalAdvance(list_->topLevelItem(i)->text(column)));
        return width > 0 ? width + column_margin : 0;
    };
    const int room = list_->viewport()->width();
    const int kinds = needed(kind) + icon_size, key_room = std::min(needed(keys), room / 4);
    const int names =
        std::clamp(needed(name), 0, std::max(0, room - kinds - key_room - std::min(needed(place), room / 8)));
    list_->setColumnWidth(kind, kinds);
    list_->setColumnWidth(name, names);
    list_->setColumnWidth(keys, key_room);
    list_->setColumnWidth(place, std::max(0, room - kinds - names - key_room));
}

bool FinderDialog::eventFilter(QObject* watched, QEvent* event) {
    if (watched == list_->viewport() && event->type() == QEvent::Resize) fit_columns();
    if (watched == list_->viewport() && event->type() == QEvent::ToolTip) {
        show_tip(*static_cast<QHelpEvent*>(event));
        return true;
    }
    if (watched == line_ && moves_through(list_, event)) return true;
    return QDialog::eventFilter(watched, event);
}

const Findable* FinderDialog::at(const QTreeWidgetItem* item) const {
    return item ? &all_[item->data(kind, Qt::UserRole).toULongLong()] : nullptr;
}

void FinderDialog::show_tip(const QHelpEvent& event) const {
    const auto* item = list_->itemAt(event.pos());
    const auto* what = at(item);
    if (!what) return QToolTip::hideText();
    const auto words = what->why_not.isEmpty() ? what->also : what->why_not;
    const auto picture = what->picture ? picture_text(what->picture()) : QString();
    QToolTip::showText(event.globalPos(),
                       picture.isEmpty() ? words : picture + Qt::convertFromPlainText(words),
                       list_->viewport(), list_->visualItemRect(item));
}

void FinderDialog::go() {
    const auto* chosen = at(list_->currentItem());
    if (!chosen || !chosen->why_not.isEmpty()) return;
    const auto& what = *chosen;
    // Once this has given the keyboard back: what is gone to may take it.
    QTimer::singleShot(0, parent(), what.go);
    accept();
}

}  // namespace ir::widgets
