#include "widgets/panels/messages_panel.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLineEdit>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/panels/empty_tree_view.h"
#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

const char* severity_icon(Severity severity) {
    switch (severity) {
        case Severity::error:
            return "error";
        case Severity::warning:
            return "warning";
        default:
            return "note";
    }
}

/// Says why it is empty.
class MessagesTable : public QTableView {
  public:
    MessagesTable(const MessagesModel& messages, QWidget* parent) : QTableView(parent), messages_(messages) {}

  protected:
    void paintEvent(QPaintEvent* event) override {
        QTableView::paintEvent(event);
        paint_empty_text(*this, messages_.rowCount() == 0 ? MessagesPanel::tr("Nothing was said yet.")
                                                          : MessagesPanel::tr("The filter hides them all."));
    }

  private:
    const MessagesModel& messages_;
};

}  // namespace

MessagesPanel::MessagesPanel(QWidget* parent)
    : QWidget(parent),
      model_(new MessagesModel(this)),
      filter_(new MessagesFilter(this)),
      view_(new MessagesTable(*model_, this)) {
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
    bar->setSpacing(4);
    buttons_[int(Severity::error)] = make_severity_button(Severity::error);
    buttons_[int(Severity::warning)] = make_severity_button(Severity::warning);
    buttons_[int(Severity::note)] = make_severity_button(Severity::note);
    for (auto severity : {Severity::error, Severity::warning, Severity::note})
        bar->addWidget(buttons_[int(severity)]);
    sources_ = new QComboBox(this);
    sources_->setObjectName(QStringLiteral("sources"));
    sources_->setToolTip(tr("Show the messages of one source"));
    sources_->setAccessibleName(sources_->toolTip());
    sources_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    connect(sources_, &QComboBox::activated, this,
            [this] { filter_->set_source(sources_->currentData().toString()); });
    bar->addWidget(sources_);
    auto* search = new QLineEdit(this);
    search->setMinimumWidth(60);
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
    add_actions();
    connect(model_, &MessagesModel::counts_changed, this, &MessagesPanel::update_counts);
    update_counts();
}

void MessagesPanel::add_actions() {
    go_ = new QAction(tr("Go to what it is about"), view_);
    connect(go_, &QAction::triggered, this, [this] { go(view_->currentIndex()); });
    auto* copy_action = new QAction(tr("Copy"), view_);
    copy_action->setShortcut(QKeySequence::Copy);
    copy_action->setShortcutContext(Qt::WidgetShortcut);
    connect(copy_action, &QAction::triggered, this, &MessagesPanel::copy);
    view_->addActions({go_, copy_action});
    view_->setContextMenuPolicy(Qt::ActionsContextMenu);
    connect(view_, &QTableView::activated, this, &MessagesPanel::go);
    const auto update = [this] {
        go_->setEnabled(!view_->currentIndex().data(MessagesModel::place_role).toString().isEmpty());
    };
    connect(view_->selectionModel(), &QItemSelectionModel::currentChanged, this, update);
    connect(model_, &QAbstractItemModel::modelReset, this, update);
    update();
}

void MessagesPanel::go(const QModelIndex& at) {
    if (!at.isValid()) return;
    const Message message = model_->message(filter_->mapToSource(at).row());
    if (!message.place.empty()) emit go_to(message);
}

QToolButton* MessagesPanel::make_severity_button(Severity severity) {
    auto* button = new QToolButton(this);
    button->setIcon(icon(severity_icon(severity)));
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
        auto* button = buttons_[int(severity)];
        const int count = model_->count(severity);
        button->setText(QString::number(count));
        button->setToolTip(tr("%1: %2. Click to show or hide them.").arg(label).arg(count));
        button->setAccessibleName(label);
    };
    set(Severity::error, tr("Errors"));
    set(Severity::warning, tr("Warnings"));
    set(Severity::note, tr("Notes"));
    update_sources();
}

void MessagesPanel::update_sources() {
    const auto sources = model_->sources();
    int all = 0;
    for (const auto& source : sources) all += source.count;
    const auto set = [this](int row, const QString& text, const QString& source, const char* icon_name) {
        if (row >= sources_->count()) sources_->addItem(QString());
        sources_->setItemText(row, text);
        sources_->setItemData(row, source);
        sources_->setItemIcon(row, icon_name ? icon(icon_name) : QIcon());
    };
    set(0, tr("All sources (%1)").arg(all), {}, nullptr);
    int row = 1;
    for (const auto& source : sources) {
        const QString name = QString::fromStdString(source.source);
        set(row++, QStringLiteral("%1 (%2)").arg(name).arg(source.count), name, severity_icon(source.worst));
    }
    while (sources_->count() > row) sources_->removeItem(row);
    const int chosen = sources_->findData(filter_->source());
    sources_->setCurrentIndex(std::max(chosen, 0));
    if (chosen < 0) filter_->set_source({});
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
