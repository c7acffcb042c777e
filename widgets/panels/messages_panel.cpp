#include "widgets/panels/messages_panel.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLineEdit>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>

#include "widgets/style/icons.h"

namespace ir::widgets {

MessagesPanel::MessagesPanel(QWidget* parent)
    : QWidget(parent),
      model_(new MessagesModel(this)),
      filter_(new MessagesFilter(this)),
      view_(new QTableView(this)) {
    filter_->setSourceModel(model_);
    view_->setModel(filter_);
    view_->setSelectionBehavior(QAbstractItemView::SelectRows);
    view_->setShowGrid(false);
    view_->setWordWrap(false);
    view_->verticalHeader()->hide();
    view_->verticalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    view_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    view_->horizontalHeader()->setSectionResizeMode(MessagesModel::text_column, QHeaderView::Stretch);
    view_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    view_->horizontalHeader()->setHighlightSections(false);

    auto* bar = new QHBoxLayout;
    bar->setContentsMargins(4, 2, 4, 2);
    buttons_[int(Severity::error)] = make_severity_button(Severity::error, "error");
    buttons_[int(Severity::warning)] = make_severity_button(Severity::warning, "warning");
    buttons_[int(Severity::note)] = make_severity_button(Severity::note, "note");
    for (auto severity : {Severity::error, Severity::warning, Severity::note})
        bar->addWidget(buttons_[int(severity)]);
    auto* search = new QLineEdit(this);
    search->setPlaceholderText(tr("Filter"));
    search->setClearButtonEnabled(true);
    connect(search, &QLineEdit::textChanged, filter_, &MessagesFilter::set_text);
    bar->addWidget(search, 1);
    const auto add_button = [&](const char* icon_name, const QString& tip, void (MessagesPanel::*slot)()) {
        auto* button = new QToolButton(this);
        button->setIcon(icon(icon_name));
        button->setToolTip(tip);
        button->setAccessibleName(tip);
        button->setAutoRaise(true);
        connect(button, &QToolButton::clicked, this, slot);
        bar->addWidget(button);
    };
    add_button("copy", tr("Copy the chosen messages, or all that are shown"), &MessagesPanel::copy);
    add_button("clear", tr("Clear the messages"), &MessagesPanel::clear);

    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(bar);
    layout->addWidget(view_);
    auto* copy_action = new QAction(tr("Copy"), view_);
    copy_action->setShortcut(QKeySequence::Copy);
    copy_action->setShortcutContext(Qt::WidgetShortcut);
    connect(copy_action, &QAction::triggered, this, &MessagesPanel::copy);
    view_->addAction(copy_action);
    view_->setContextMenuPolicy(Qt::ActionsContextMenu);
    connect(model_, &MessagesModel::counts_changed, this, &MessagesPanel::update_counts);
    update_counts();
}

QToolButton* MessagesPanel::make_severity_button(Severity severity, const char* icon_name) {
    auto* button = new QToolButton(this);
    button->setIcon(icon(icon_name));
    button->setCheckable(true);
    button->setChecked(true);
    button->setAutoRaise(true);
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    connect(button, &QToolButton::toggled, this,
            [this, severity](bool on) { filter_->set_shown(severity, on); });
    return button;
}

void MessagesPanel::update_counts() {
    const auto set = [&](Severity severity, const QString& label) {
        buttons_[int(severity)]->setText(QStringLiteral("%1 %2").arg(model_->count(severity)).arg(label));
    };
    set(Severity::error, tr("errors"));
    set(Severity::warning, tr("warnings"));
    set(Severity::note, tr("notes"));
}

void MessagesPanel::add(const Message& message) {
    model_->add(message);
    view_->scrollToBottom();
}

void MessagesPanel::copy() {
    QModelIndexList rows;
    for (const auto& row : view_->selectionModel()->selectedRows()) rows << filter_->mapToSource(row);
    if (rows.isEmpty())
        for (int i = 0; i < filter_->rowCount(); ++i) rows << filter_->mapToSource(filter_->index(i, 0));
    QApplication::clipboard()->setText(model_->text(rows));
}

void MessagesPanel::clear() {
    model_->clear();
}

}  // namespace ir::widgets
