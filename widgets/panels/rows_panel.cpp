#include "widgets/panels/rows_panel.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QHeaderView>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/panels/empty_tree_view.h"

namespace ir::widgets {

RowsPanel::RowsPanel(const QStringList& headings, const QString& empty_text, QWidget* parent)
    : QWidget(parent), model_(new RowsModel(headings, this)), view_(new EmptyTreeView(empty_text, this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(view_);
    view_->setModel(model_);
    view_->setAlternatingRowColors(true);
    view_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    view_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    view_->setExpandsOnDoubleClick(false);
    view_->header()->setStretchLastSection(false);
    view_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
    view_->header()->setSectionResizeMode(0, QHeaderView::Interactive);
    view_->header()->setMinimumSectionSize(36);
    view_->viewport()->installEventFilter(this);
    connect(view_->header(), &QHeaderView::sectionResized, this, [this](int section, int, int) {
        if (section > 0) fit_columns();
    });
    view_->setTextElideMode(Qt::ElideRight);
    connect(view_, &QTreeView::clicked, this,
            [this](const QModelIndex& at) { emit row_clicked(at.data(RowsModel::key_role).toString()); });
    connect(view_, &QTreeView::activated, this,
            [this](const QModelIndex& at) { emit row_activated(at.data(RowsModel::key_role).toString()); });
    const auto remember = [this](const QModelIndex& at, bool open) {
        if (!restoring_) open_[at.data(RowsModel::key_role).toString()] = open;
    };
    connect(view_, &QTreeView::expanded, this, [remember](const QModelIndex& at) { remember(at, true); });
    connect(view_, &QTreeView::collapsed, this, [remember](const QModelIndex& at) { remember(at, false); });
    connect(model_, &QAbstractItemModel::modelReset, this, [this] {
        restoring_ = true;
        restore_folding({});
        restoring_ = false;
    });
    auto* copy_action = new QAction(tr("Copy"), view_);
    copy_action->setShortcut(QKeySequence::Copy);
    copy_action->setShortcutContext(Qt::WidgetShortcut);
    connect(copy_action, &QAction::triggered, this, &RowsPanel::copy);
    view_->addAction(copy_action);
    view_->setContextMenuPolicy(Qt::ActionsContextMenu);
}

void RowsPanel::set_rows(std::vector<Row> rows) {
    model_->set_rows(std::move(rows));
    fit_columns();
}

void RowsPanel::set_picture_size(QSize size) {
    view_->setIconSize(size);
}

bool RowsPanel::eventFilter(QObject* watched, QEvent* event) {
    // The viewport, not the panel: scroll bars come and go.
    if (event->type() == QEvent::Resize) fit_columns();
    return QWidget::eventFilter(watched, event);
}

void RowsPanel::fit_columns() {
    int others = 0;
    for (int c = 1; c < model_->columnCount(); ++c) others += view_->header()->sectionSize(c);
    view_->setColumnWidth(0, std::max(name_width_, view_->viewport()->width() - others));
}

void RowsPanel::restore_folding(const QModelIndex& parent) {
    for (int i = 0; i < model_->rowCount(parent); ++i) {
        const QModelIndex row = model_->index(i, 0, parent);
        if (!model_->hasChildren(row)) continue;
        const auto known = open_.find(row.data(RowsModel::key_role).toString());
        const bool folded = row.data(RowsModel::folded_role).toBool();
        view_->setExpanded(row, known == open_.end() ? !folded : *known);
        restore_folding(row);
    }
}

void RowsPanel::copy() {
    QStringList lines;
    for (const QModelIndex& row : view_->selectionModel()->selectedRows()) {
        QStringList cells;
        for (int c = 0; c < model_->columnCount(); ++c) cells << row.siblingAtColumn(c).data().toString();
        lines << cells.join(QLatin1Char('\t'));
    }
    QApplication::clipboard()->setText(lines.join(QLatin1Char('\n')));
}

}  // namespace ir::widgets
