#include "widgets/views/search_combo.h"

#include <QHelpEvent>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QScreen>
#include <QToolTip>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/panels/controls.h"
#include "widgets/style/rich_text.h"

namespace ir::widgets {
namespace {

constexpr int popup_width = 260, popup_height = 460;  // logical pixels

}  // namespace

SearchCombo::SearchCombo(QWidget* parent)
    : QComboBox(parent),
      popup_(new QFrame(this, Qt::Popup)),
      line_(new QLineEdit(popup_)),
      nothing_(new QLabel(nothing_fits(), popup_)),
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
    list_->viewport()->installEventFilter(this);
    auto* layout = new QVBoxLayout(popup_);
    layout->setContentsMargins(2, 2, 2, 2);
    layout->setSpacing(2);
    layout->addWidget(line_);
    layout->addWidget(nothing_);
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
    int best = -1;
    for (const auto letters : {Letters::all, Letters::some})
        if (best < 0) best = show_fitting(query, letters);
    nothing_->setVisible(best < 0);
    list_->setCurrentIndex(model()->index(best, 0));
}

/// The entry that fits best; -1: none does.
int SearchCombo::show_fitting(const QString& query, Letters letters) {
    int heading = -1, best = -1, most = 0;
    for (int i = 0; i < count(); ++i) {
        const bool is_heading = !model()->index(i, 0).flags().testFlag(Qt::ItemIsEnabled);
        if (is_heading) heading = i;
        const int fit =
            is_heading ? 0 : fit_of(query, itemText(i), {itemText(heading), itemData(i).toString()}, letters);
        list_->setRowHidden(i, fit == 0);
        if (fit > 0 && heading >= 0) list_->setRowHidden(heading, false);
        if (fit > most) {
            most = fit;
            best = i;
        }
    }
    return best;
}

void SearchCombo::choose(const QModelIndex& entry) {
    if (!entry.flags().testFlag(Qt::ItemIsEnabled)) return;
    const int row = entry.row();
    hidePopup();
    setCurrentIndex(row);
    emit activated(row);
    emit textActivated(itemText(row));
}

void SearchCombo::show_tip(const QHelpEvent& event) const {
    const auto entry = list_->indexAt(event.pos());
    const auto key = entry.data(Qt::UserRole).toString();
    const auto picture = pictures_ && !key.isEmpty() ? pictures_(key) : QImage();
    QToolTip::showText(event.globalPos(), picture_text(picture) + entry.data(Qt::ToolTipRole).toString(),
                       list_->viewport(), list_->visualRect(entry));
}

bool SearchCombo::eventFilter(QObject* watched, QEvent* event) {
    if (watched == line_ && moves_through(list_, event)) return true;
    if (watched == list_->viewport() && event->type() == QEvent::ToolTip) {
        show_tip(*static_cast<QHelpEvent*>(event));
        return true;
    }
    return QComboBox::eventFilter(watched, event);
}

}  // namespace ir::widgets
