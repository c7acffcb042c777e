#include "widgets/document/ordered_list.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QListWidget>
#include <QMenu>
#include <QToolButton>
#include <QVBoxLayout>

#include "widgets/document/fields.h"

namespace ir::widgets {

OrderedList::OrderedList(const char* name, const QString& what, int min, QWidget* parent)
    : QWidget(parent), list_(new QListWidget(this)), what_(what), min_(min) {
    setObjectName(QLatin1String(name));
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(2);
    list_->setAlternatingRowColors(true);
    list_->setSpacing(1);
    list_->setTextElideMode(Qt::ElideRight);
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    list_->setAccessibleName(name);
    list_->installEventFilter(this);
    layout->addWidget(list_);
    auto* row = new QHBoxLayout;
    row->setSpacing(1);
    const auto add_button = [&](const char* role, const char* drawing, const QString& tip) {
        auto* button = make_button(drawing, tip, this);
        button->setObjectName(QStringLiteral("%1.%2").arg(QLatin1String(name), QLatin1String(role)));
        row->addWidget(button);
        return button;
    };
    add_ = add_button("add", "add", tr("Add a %1 (Ins)").arg(what));
    duplicate_ = add_button("duplicate", "copy", tr("Duplicate the %1 (Ctrl+D)").arg(what));
    up_ = add_button("up", "up", tr("Move up (Alt+Up)"));
    down_ = add_button("down", "down", tr("Move down (Alt+Down)"));
    remove_ = add_button("remove", "clear", tr("Remove the %1 (Del)").arg(what));
    row->addStretch();
    layout->addLayout(row);
    connect(list_, &QListWidget::currentRowChanged, this, [this](int index) {
        if (showing_) return;
        update_buttons();
        emit current_changed(index);
    });
    connect(add_, &QToolButton::clicked, this, &OrderedList::add_wanted);
    connect(duplicate_, &QToolButton::clicked, this, [this] { emit duplicate_wanted(current()); });
    connect(remove_, &QToolButton::clicked, this, [this] { emit remove_wanted(current()); });
    connect(up_, &QToolButton::clicked, this, [this] { emit move_wanted(current(), current() - 1); });
    connect(down_, &QToolButton::clicked, this, [this] { emit move_wanted(current(), current() + 1); });
}

void OrderedList::set_add_menu(QMenu* menu) {
    add_->setMenu(menu);
    add_->setPopupMode(QToolButton::InstantPopup);
    add_->setStyleSheet(QStringLiteral("QToolButton::menu-indicator { image: none; }"));
}

void OrderedList::set_movable(bool movable) {
    movable_ = movable;
    up_->setVisible(movable);
    down_->setVisible(movable);
}

int OrderedList::current() const {
    return list_->currentRow();
}

void OrderedList::show_lines(const std::vector<Line>& lines, int current) {
    showing_ = true;
    while (list_->count() > int(lines.size())) delete list_->takeItem(list_->count() - 1);
    while (list_->count() < int(lines.size())) list_->addItem(QString());
    for (int i = 0; i < list_->count(); ++i) {
        list_->item(i)->setText(lines[std::size_t(i)].text);
        list_->item(i)->setToolTip(lines[std::size_t(i)].tooltip);
    }
    list_->setCurrentRow(lines.empty() ? -1 : std::clamp(current, 0, int(lines.size()) - 1));
    const int line = list_->fontMetrics().lineSpacing() + 6;
    list_->setFixedHeight(std::clamp(int(lines.size()), 2, 5) * line + 4);
    showing_ = false;
    update_buttons();
}

void OrderedList::set_usable(const QString& why_not) {
    why_not_ = why_not;
    update_buttons();
}

void OrderedList::update_buttons() {
    const int index = current(), count = list_->count();
    const auto set = [&](QToolButton* button, const QString& why_not) {
        ir::widgets::set_usable(button, why_not_.isEmpty() ? why_not : why_not_);
    };
    const QString none = index < 0 ? tr("There is no %1.").arg(what_) : QString();
    set(add_, {});
    set(duplicate_, none);
    set(up_, index == 0 ? tr("It is the first already.") : none);
    set(down_, index == count - 1 && index >= 0 ? tr("It is the last already.") : none);
    set(remove_, count == min_ && index >= 0 ? tr("One has to stay.") : none);
}

QToolButton* OrderedList::button_for(const QKeyEvent& event) const {
    switch (int(event.modifiers() & ~Qt::KeypadModifier) | event.key()) {
        case Qt::Key_Insert:
            return add_;
        case int(Qt::ControlModifier) | Qt::Key_D:
            return duplicate_;
        case Qt::Key_Delete:
            return remove_;
        case int(Qt::AltModifier) | Qt::Key_Up:
            return movable_ ? up_ : nullptr;
        case int(Qt::AltModifier) | Qt::Key_Down:
            return movable_ ? down_ : nullptr;
        default:
            return nullptr;
    }
}

bool OrderedList::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::ShortcutOverride && event->type() != QEvent::KeyPress)
        return QWidget::eventFilter(watched, event);
    auto* button = button_for(*static_cast<QKeyEvent*>(event));
    if (!button) return QWidget::eventFilter(watched, event);
    event->accept();  // the window's own shortcuts with these keys wait
    if (event->type() == QEvent::KeyPress) button->menu() ? button->showMenu() : button->click();
    return true;
}

}  // namespace ir::widgets
