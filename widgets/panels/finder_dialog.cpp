#include "widgets/panels/finder_dialog.h"

#include <QEvent>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QTimer>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <numeric>

#include "widgets/panels/controls.h"

namespace ir::widgets {
namespace {

constexpr int usual_width = 780, usual_height = 420;  // logical pixels
constexpr int column_margin = 14, icon_size = 16;
constexpr std::size_t max_shown = 200;
enum Column { kind, name, place, keys };

/// Fits are sums over words; a name that is nearly the query stands before a long one.
constexpr int at_start = 1000, at_word = 800, within = 500, elsewhere = 200, with_gaps = 100;

/// Whether all letters of the word come in this order, without too much between them.
bool has_letters(const QString& text, const QString& word) {
    constexpr qsizetype gaps = 3;  // times the word's length
    for (qsizetype start = text.indexOf(word[0], 0, Qt::CaseInsensitive); start >= 0;
         start = text.indexOf(word[0], start + 1, Qt::CaseInsensitive)) {
        qsizetype at = start;
        for (const QChar letter : word.sliced(1))
            if (at >= 0) at = text.indexOf(letter, at + 1, Qt::CaseInsensitive);
        if (at >= 0 && at - start < gaps * word.size()) return true;
    }
    return false;
}

bool begins_word(const QString& text, qsizetype at) {
    return at > 0 && !text[at - 1].isLetterOrNumber();
}

int fit_of_word(const QString& word, const Findable& what) {
    const QString& name = what.name;
    int best = 0;
    for (qsizetype at = name.indexOf(word, 0, Qt::CaseInsensitive); at >= 0;
         at = name.indexOf(word, at + 1, Qt::CaseInsensitive))
        best = std::max(best, at == 0 ? at_start : begins_word(name, at) ? at_word : within);
    if (best > 0) return best;
    for (const auto& other : {what.also, what.kind, what.place})
        if (other.contains(word, Qt::CaseInsensitive)) return elsewhere;
    return word.size() > 1 && has_letters(name, word) ? with_gaps : 0;
}

}  // namespace

int fit_of(const QString& query, const Findable& what) {
    constexpr int max_length = 99;
    int sum = 0;
    const auto words = query.split(QLatin1Char(' '), Qt::SkipEmptyParts);
    for (const auto& word : words) {
        const int fit = fit_of_word(word, what);
        if (fit == 0) return 0;
        sum += fit;
    }
    return words.isEmpty() ? 1 : sum + max_length - std::min(max_length, int(what.name.size()));
}

std::vector<std::size_t> found(const QString& query, const std::vector<Findable>& all) {
    std::vector<int> fits;
    for (const auto& each : all) fits.push_back(fit_of(query, each));
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), 0);
    std::erase_if(order, [&](std::size_t i) { return fits[i] == 0; });
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return fits[a] > fits[b]; });
    return order;
}

FinderDialog::FinderDialog(std::vector<Findable> all, QWidget* parent)
    : QDialog(parent, Qt::Dialog | Qt::FramelessWindowHint), all_(std::move(all)) {
    setWindowTitle(tr("Find"));
    setObjectName(QStringLiteral("finder"));
    auto* layout = new QVBoxLayout(this);
    line_ = new QLineEdit(this);
    line_->setPlaceholderText(tr("Find a buffer, a parameter, an action, a sample …"));
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
    nothing_ = new QLabel(tr("Nothing has all of these words."), this);
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
        item->setToolTip(name, is_open ? what.also : what.why_not);
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
    if (watched == line_ && moves_through(list_, event)) return true;
    return QDialog::eventFilter(watched, event);
}

void FinderDialog::go() {
    const auto* item = list_->currentItem();
    if (!item) return;
    const auto& what = all_[item->data(kind, Qt::UserRole).toULongLong()];
    if (!what.why_not.isEmpty()) return;
    // Once this has given the keyboard back: what is gone to may take it.
    QTimer::singleShot(0, parent(), what.go);
    accept();
}

}  // namespace ir::widgets
