#include "widgets/views/search_combo.h"

#include <QLineEdit>
#include <QListView>
#include <QScreen>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/panels/controls.h"

namespace ir::widgets {
namespace {

constexpr int popup_width = 260, popup_height = 460;  // logical pixels

}  // namespace

SearchCombo::SearchCombo(QWidget* parent)
    : QComboBox(parent),
      popup_(new QFrame(this, Qt::Popup)),
      line_(new QLineEdit(popup_)),
      list_(new QListView(popup_)) {
    popup_->setFrameShape(QFrame::StyledPanel);
    popup_->setAttribute(Qt::WA_NoMouseReplay);  // a click on this closes the list, and does not open it anew
    line_->setPlaceholderText(tr("Search"));
    line_->setAccessibleName(line_->placeholderText());
    line_->setClearButtonEnabled(true);
    line_->installEventFilter(this);
    list_->setModel(model());
    list_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    list_->setFrameShape(QFrame::NoFrame);
    list_->setFocusPolicy(Qt::NoFocus);
    list_->setAccessibleName(tr("What fits"));
    auto* layout = new QVBoxLayout(popup_);
    layout->setContentsMargins(2, 2, 2, 2);
    layout->setSpacing(2);
    layout->addWidget(line_);
    layout->addWidget(list_);
    connect(line_, &QLineEdit::textChanged, this, &SearchCombo::search);
    connect(line_, &QLineEdit::returnPressed, this, [this] { choose(list_->currentIndex()); });
    connect(list_, &QListView::clicked, this, &SearchCombo::choose);
}

void SearchCombo::showPopup() {
    line_->clear();
    search({});
    list_->setCurrentIndex(model()->index(currentIndex(), 0));
    const int rows = std::max(0, list_->sizeHintForRow(0)) * (count() + 1);
    const QRect room = screen()->availableGeometry();
    QSize size(std::max(popup_width, width()), std::min(popup_height, rows + line_->sizeHint().height() + 8));
    QPoint place = mapToGlobal(rect().bottomLeft());
    if (place.y() + size.height() > room.bottom())
        place.ry() = std::max(room.top(), mapToGlobal(QPoint()).y() - size.height());
    place.rx() = std::clamp(place.x(), room.left(), std::max(room.left(), room.right() - size.width()));
    popup_->setGeometry(QRect(place, size));
    popup_->show();
    list_->scrollTo(list_->currentIndex());
    line_->setFocus(Qt::PopupFocusReason);
}

void SearchCombo::hidePopup() {
    popup_->hide();
    QComboBox::hidePopup();
}

/// Names keep the room.
void SearchCombo::initStyleOption(QStyleOptionComboBox* option) const {
    QComboBox::initStyleOption(option);
    option->currentIcon = {};
}

void SearchCombo::search(const QString& query) {
    const auto words = query.split(QLatin1Char(' '), Qt::SkipEmptyParts);
    int heading = -1, first = -1;
    for (int i = 0; i < count(); ++i) {
        const auto entry = model()->index(i, 0);
        const bool is_heading = !entry.flags().testFlag(Qt::ItemIsEnabled);
        if (is_heading) heading = i;
        const auto text =
            QStringList{itemText(heading), itemText(i), itemData(i).toString()}.join(QLatin1Char(' '));
        const bool matches = !is_heading && std::all_of(words.begin(), words.end(), [&](const QString& word) {
            return text.contains(word, Qt::CaseInsensitive);
        });
        list_->setRowHidden(i, !matches);
        if (matches && heading >= 0) list_->setRowHidden(heading, false);
        if (matches && first < 0) first = i;
    }
    list_->setCurrentIndex(model()->index(first, 0));
}

void SearchCombo::choose(const QModelIndex& entry) {
    if (!entry.flags().testFlag(Qt::ItemIsEnabled)) return;
    const int row = entry.row();
    hidePopup();
    setCurrentIndex(row);
    emit activated(row);
    emit textActivated(itemText(row));
}

bool SearchCombo::eventFilter(QObject* watched, QEvent* event) {
    if (watched == line_ && moves_through(list_, event)) return true;
    return QComboBox::eventFilter(watched, event);
}

}  // namespace ir::widgets
