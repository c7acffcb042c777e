#include "widgets/results/results_panel.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QSplitter>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/panels/empty_tree_view.h"
#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

QToolButton* button_for(QAction* action) {
    auto* button = new QToolButton;
    button->setDefaultAction(action);
    button->setAutoRaise(true);
    button->setAccessibleName(action->text());
    return button;
}

}  // namespace

ResultsPanel::ResultsPanel(QWidget* parent)
    : QWidget(parent),
      model_(new ResultsModel(this)),
      filter_(new ResultsFilter(this)),
      view_(new EmptyTreeView({}, this)) {
    filter_->setSourceModel(model_);
    view_->setModel(filter_);
    view_->setRootIsDecorated(false);
    view_->setUniformRowHeights(true);
    view_->setAlternatingRowColors(true);
    view_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    view_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    view_->setAccessibleName(tr("Kept results"));
    view_->setSortingEnabled(true);
    view_->sortByColumn(ResultsModel::date_column, Qt::DescendingOrder);
    view_->header()->setStretchLastSection(false);
    view_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
    for (const int column : {ResultsModel::experiment_column, ResultsModel::method_column})
        view_->header()->setSectionResizeMode(column, QHeaderView::Stretch);
    view_->header()->setMinimumSectionSize(36);
    make_actions();
    auto* split = new QSplitter(Qt::Vertical);
    split->addWidget(view_);
    split->addWidget(make_changes());
    split->setStretchFactor(0, 3);
    split->setStretchFactor(1, 2);
    split->setChildrenCollapsible(false);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(make_bar());
    layout->addWidget(split, 1);
    connect(view_->selectionModel(), &QItemSelectionModel::selectionChanged, this, [this] {
        update_actions();
        emit selection_changed();
    });
    connect(model_, &QAbstractItemModel::rowsRemoved, this, &ResultsPanel::update_actions);
    connect(model_, &QAbstractItemModel::modelReset, this, &ResultsPanel::update_actions);
    connect(model_, &QAbstractItemModel::dataChanged, this, &ResultsPanel::update_actions);
    update_actions();
}

QAction* ResultsPanel::add(const QString& name, const QString& text, const QString& tip,
                           const char* icon_name, const QList<QKeySequence>& keys) {
    auto* action = new QAction(icon_name ? icon(icon_name) : QIcon(), text, this);
    action->setObjectName(name);
    action->setShortcuts(keys);
    action->setShortcutContext(Qt::WidgetShortcut);
    action->setData(
        keys.isEmpty() ? tip
                       : QStringLiteral("%1 (%2)").arg(tip, keys.front().toString(QKeySequence::NativeText)));
    action->setToolTip(action->data().toString());
    view_->addAction(action);
    return action;
}

void ResultsPanel::make_actions() {
    using K = QKeySequence;
    auto* show_a = add("show-a", tr("Show as A"), tr("Show the result in the active view"), nullptr,
                       {K(Qt::Key_Return), K(Qt::Key_Enter)});
    auto* show_b = add("show-b", tr("Show as B"), tr("Compare the active view's A with the result"), nullptr,
                       {K(Qt::SHIFT | Qt::Key_Return), K(Qt::SHIFT | Qt::Key_Enter)});
    show_a->setIconText(QStringLiteral("A"));
    show_b->setIconText(QStringLiteral("B"));
    auto* changes =
        add("changes", tr("What changed …"),
            tr("What differs between two chosen results, or between one and what its experiment would "
               "render now"),
            "comparison", {K(Qt::CTRL | Qt::Key_Return), K(Qt::CTRL | Qt::Key_Enter)});
    auto* reveal =
        add("reveal", tr("Reveal file"), tr("Open the folder that holds the result's files"), "open", {});
    auto* copy = add("copy", tr("Copy rows"), tr("Copy the chosen rows as text"), "copy", {K::Copy});
    auto* remove =
        add("delete", tr("Delete …"), tr("Delete the chosen results from the disk. This cannot be undone"),
            "clear", {K(Qt::Key_Delete)});
    view_->setContextMenuPolicy(Qt::ActionsContextMenu);
    const auto first = [this] { return selected().isEmpty() ? QString() : selected().front(); };
    connect(show_a, &QAction::triggered, this, [this, first] { emit show_wanted(first(), false); });
    connect(show_b, &QAction::triggered, this, [this, first] { emit show_wanted(first(), true); });
    connect(changes, &QAction::triggered, this, [this] { emit changes_wanted(selected()); });
    connect(reveal, &QAction::triggered, this, [this, first] { emit reveal_wanted(first()); });
    connect(copy, &QAction::triggered, this, &ResultsPanel::copy_rows);
    connect(remove, &QAction::triggered, this, [this] { emit delete_wanted(selected()); });
    connect(view_, &QTreeView::doubleClicked, show_a, &QAction::trigger);
}

QWidget* ResultsPanel::make_bar() {
    auto* bar = new QWidget;
    auto* row = new QHBoxLayout(bar);
    row->setContentsMargins(4, 2, 4, 2);
    row->setSpacing(2);
    for (const char* name : {"show-a", "show-b", "changes", "reveal", "delete"})
        row->addWidget(button_for(action(QLatin1String(name))));
    search_ = new QLineEdit;
    search_->setObjectName(QStringLiteral("filter"));
    search_->setMinimumWidth(60);
    search_->setPlaceholderText(tr("Filter results"));
    search_->setAccessibleName(search_->placeholderText());
    search_->setClearButtonEnabled(true);
    connect(search_, &QLineEdit::textChanged, this, [this](const QString& text) {
        filter_->set_text(text);
        set_empty_text(empty_text_);
    });
    row->addWidget(search_, 1);
    return bar;
}

QWidget* ResultsPanel::make_changes() {
    changes_ = new QWidget;
    auto* column = new QVBoxLayout(changes_);
    column->setContentsMargins(0, 2, 0, 0);
    column->setSpacing(2);
    auto* line = new QHBoxLayout;
    line->setContentsMargins(6, 0, 4, 0);
    changes_title_ = new QLabel;
    changes_title_->setObjectName(QStringLiteral("changes-title"));
    changes_title_->setWordWrap(true);
    line->addWidget(changes_title_, 1);
    changes_list_ = new QListWidget;
    changes_list_->setObjectName(QStringLiteral("changes-list"));
    changes_list_->setAccessibleName(tr("What changed"));
    changes_list_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    changes_list_->setWordWrap(true);
    changes_list_->setFrameShape(QFrame::NoFrame);
    const auto add_button = [&](const char* icon_name, const QString& tip, auto slot) {
        auto* button = new QToolButton;
        button->setIcon(icon(icon_name));
        button->setToolTip(tip);
        button->setAccessibleName(tip);
        button->setAutoRaise(true);
        connect(button, &QToolButton::clicked, this, slot);
        line->addWidget(button);
    };
    add_button("copy", tr("Copy the chosen lines, or all"), &ResultsPanel::copy_changes);
    add_button("cancel", tr("Close the list of changes"), &ResultsPanel::hide_changes);
    auto* copy = new QAction(tr("Copy"), changes_list_);
    copy->setShortcut(QKeySequence::Copy);
    copy->setShortcutContext(Qt::WidgetShortcut);
    connect(copy, &QAction::triggered, this, &ResultsPanel::copy_changes);
    changes_list_->addAction(copy);
    changes_list_->setContextMenuPolicy(Qt::ActionsContextMenu);
    column->addLayout(line);
    column->addWidget(changes_list_, 1);
    changes_->hide();
    return changes_;
}

void ResultsPanel::set_empty_text(const QString& text) {
    empty_text_ = text;
    const bool filtered = model_->rowCount() > 0;
    view_->set_empty_text(filtered ? tr("No result matches the filter.") : text);
}

void ResultsPanel::set_rows(std::vector<ResultRow> rows) {
    const auto chosen = selected();
    const QSignalBlocker silent(this);
    bool was_reset = false;
    const auto watch =
        connect(model_, &QAbstractItemModel::modelReset, this, [&was_reset] { was_reset = true; });
    model_->set_rows(std::move(rows));
    disconnect(watch);
    if (was_reset) select(chosen);
    set_empty_text(empty_text_);
    update_actions();
}

void ResultsPanel::set_read_only(const QString& reason) {
    read_only_ = reason;
    update_actions();
}

QStringList ResultsPanel::selected() const {
    std::vector<const ResultRow*> rows;
    for (const auto& index : view_->selectionModel()->selectedRows())
        if (const auto* row = model_->find(index.data(ResultsModel::key_role).toString()))
            rows.push_back(row);
    std::sort(rows.begin(), rows.end(), [](const auto* a, const auto* b) { return a->date < b->date; });
    QStringList keys;
    for (const auto* row : rows) keys << row->key;
    return keys;
}

void ResultsPanel::select(const QStringList& keys) {
    QItemSelection chosen;
    for (int row = 0; row < filter_->rowCount(); ++row) {
        const auto at = filter_->index(row, 0);
        if (keys.contains(at.data(ResultsModel::key_role).toString())) chosen.select(at, at);
    }
    view_->selectionModel()->select(chosen, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
}

void ResultsPanel::update_actions() {
    const auto keys = selected();
    const auto set = [this](const char* name, bool enabled, const QString& why = {}) {
        auto* each = action(QLatin1String(name));
        each->setEnabled(enabled);
        each->setToolTip(enabled || why.isEmpty()
                             ? each->data().toString()
                             : QStringLiteral("%1.\n%2").arg(each->data().toString(), why));
    };
    const auto one = tr("Choose one result.");
    set("show-a", keys.size() == 1, one);
    set("show-b", keys.size() == 1, one);
    set("reveal", keys.size() == 1, one);
    set("changes", keys.size() == 1 || keys.size() == 2, tr("Choose one result, or two."));
    set("copy", !keys.isEmpty());
    set("delete", !keys.isEmpty() && read_only_.isEmpty(),
        read_only_.isEmpty() ? tr("Choose the results.") : read_only_);
}

void ResultsPanel::show_changes(const QString& title, const QStringList& lines, const QString& nothing) {
    changes_title_->setText(title);
    changes_list_->clear();
    changes_list_->addItems(lines.isEmpty() ? QStringList{nothing} : lines);
    changes_->show();
}

void ResultsPanel::hide_changes() {
    changes_->hide();
    changes_list_->clear();
}

void ResultsPanel::copy_rows() {
    QStringList lines;
    for (const auto& row : view_->selectionModel()->selectedRows()) {
        QStringList cells;
        for (int c = 0; c < model_->columnCount(); ++c) cells << row.siblingAtColumn(c).data().toString();
        lines << cells.join(QLatin1Char('\t'));
    }
    QApplication::clipboard()->setText(lines.join(QLatin1Char('\n')));
}

void ResultsPanel::copy_changes() {
    QStringList lines;
    for (int i = 0; i < changes_list_->count(); ++i) {
        const auto* item = changes_list_->item(i);
        if (item->isSelected() || changes_list_->selectedItems().isEmpty()) lines << item->text();
    }
    QApplication::clipboard()->setText(changes_title_->text() + QLatin1Char('\n') +
                                       lines.join(QLatin1Char('\n')));
}

}  // namespace ir::widgets
