#include "widgets/document/project_tree.h"

#include <QAction>
#include <QHeaderView>
#include <QKeyEvent>
#include <QToolTip>

#include "widgets/document/project_model.h"

namespace ir::widgets {

ProjectFilter::ProjectFilter(QObject* parent) : QSortFilterProxyModel(parent) {
    setRecursiveFilteringEnabled(true);
    setAutoAcceptChildRows(true);
}

void ProjectFilter::set_text(const QString& text) {
    text_ = text.trimmed();
    invalidateFilter();
}

bool ProjectFilter::filterAcceptsRow(int row, const QModelIndex& parent) const {
    if (text_.isEmpty()) return true;
    const QModelIndex name = sourceModel()->index(row, ProjectModel::name_column, parent);
    const QModelIndex detail = name.siblingAtColumn(ProjectModel::detail_column);
    const bool is_item = !name.data(ProjectModel::key_role).toString().startsWith(QLatin1String("group:"));
    return is_item && (name.data().toString().contains(text_, Qt::CaseInsensitive) ||
                       detail.data().toString().contains(text_, Qt::CaseInsensitive));
}

ProjectTree::ProjectTree(QWidget* parent) : QTreeView(parent) {
    setAlternatingRowColors(true);
    setUniformRowHeights(true);
    setExpandsOnDoubleClick(false);
    setSelectionMode(QAbstractItemView::SingleSelection);
    setEditTriggers(QAbstractItemView::NoEditTriggers);
    setDragDropMode(QAbstractItemView::InternalMove);
    setDefaultDropAction(Qt::MoveAction);
    setDragDropOverwriteMode(false);
    setContextMenuPolicy(Qt::CustomContextMenu);
    setTextElideMode(Qt::ElideRight);
    setIndentation(14);
    setHeaderHidden(true);
    const auto remember = [this](const QModelIndex& at, bool open) {
        if (!restoring_) open_[at.data(ProjectModel::key_role).toString()] = open;
    };
    connect(this, &QTreeView::expanded, this, [remember](const QModelIndex& at) { remember(at, true); });
    connect(this, &QTreeView::collapsed, this, [remember](const QModelIndex& at) { remember(at, false); });
}

void ProjectTree::setModel(QAbstractItemModel* model) {
    QTreeView::setModel(model);
    header()->setStretchLastSection(true);
    header()->setMinimumSectionSize(60);
}

void ProjectTree::resizeEvent(QResizeEvent* event) {
    QTreeView::resizeEvent(event);
    setColumnWidth(ProjectModel::name_column, viewport()->width() * 11 / 20);
}

void ProjectTree::restore_folding(bool all) {
    restoring_ = true;
    restore_below({}, all);
    restoring_ = false;
}

void ProjectTree::restore_below(const QModelIndex& parent, bool all) {
    for (int row = 0; row < model()->rowCount(parent); ++row) {
        const QModelIndex index = model()->index(row, 0, parent);
        setFirstColumnSpanned(row, parent, !(index.flags() & Qt::ItemIsEnabled));
        if (!model()->hasChildren(index)) continue;
        const auto known = open_.find(index.data(ProjectModel::key_role).toString());
        const bool is_group = index.data(ProjectModel::is_group_role).toBool();
        setExpanded(index, all || (known == open_.end() ? is_group : *known));
        restore_below(index, all);
    }
}

void ProjectTree::add_key(const QKeySequence& key, QAction* action) {
    keys_.insert(key, action);
}

QAction* ProjectTree::action_for(const QKeyEvent& event) const {
    const auto modifiers = event.modifiers() & ~Qt::KeypadModifier;
    return keys_.value(QKeySequence(int(modifiers) | event.key()));
}

bool ProjectTree::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride && state() != EditingState) {
        if (action_for(*static_cast<QKeyEvent*>(event))) {
            event->accept();  // comes back as a key press
            return true;
        }
    }
    return QTreeView::event(event);
}

void ProjectTree::keyPressEvent(QKeyEvent* event) {
    auto* action = action_for(*event);
    if (!action) return QTreeView::keyPressEvent(event);
    if (action->isEnabled()) return action->trigger();
    const QRect row = visualRect(currentIndex());
    QToolTip::showText(viewport()->mapToGlobal(row.bottomLeft()), action->toolTip(), this);
}

}  // namespace ir::widgets
