#include "widgets/document/project_panel.h"

#include <QAction>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QMenu>
#include <QToolButton>
#include <QVBoxLayout>

#include "widgets/document/makers.h"
#include "widgets/document/project_model.h"
#include "widgets/document/project_tree.h"
#include "widgets/style/icons.h"

namespace ir::widgets {

ProjectPanel::ProjectPanel(QWidget* parent)
    : QWidget(parent),
      model_(new ProjectModel(this)),
      filter_(new ProjectFilter(this)),
      view_(new ProjectTree(this)),
      filter_line_(new QLineEdit(this)),
      add_menu_(new QMenu(this)) {
    filter_->setSourceModel(model_);
    view_->setModel(filter_);
    view_->setObjectName(QStringLiteral("project-tree"));
    view_->setAccessibleName(tr("Items of the project"));
    filter_line_->setObjectName(QStringLiteral("project-filter"));
    filter_line_->setPlaceholderText(tr("Filter items"));
    filter_line_->setAccessibleName(tr("Filter items"));
    filter_line_->setClearButtonEnabled(true);
    connect(filter_line_, &QLineEdit::textChanged, this, [this](const QString& text) {
        filter_->set_text(text);
        view_->restore_folding(!text.isEmpty());
        select(announced_);
    });
    make_actions();
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 4, 0, 0);
    layout->setSpacing(4);
    layout->addLayout(button_row());
    layout->addWidget(view_, 1);
    setTabOrder(filter_line_, view_);
    connect(model_, &ProjectModel::rename_wanted, this, [this](const ItemRef& item, const QString& name) {
        edit(makers::rename(item, name.toStdString()));
    });
    connect(
        model_, &ProjectModel::move_wanted, this,
        [this](const ItemRef& item, int position) { move_to(item, position); },
        Qt::QueuedConnection);  // a drag must be over before the tree changes
    connect(view_->selectionModel(), &QItemSelectionModel::currentChanged, this, [this] { announce(); });
    connect(view_, &QTreeView::activated, this,
            [this](const QModelIndex& at) { activate(model_->item(filter_->mapToSource(at))); });
    connect(view_, &QWidget::customContextMenuRequested, this, &ProjectPanel::show_menu);
    update_actions();
}

void ProjectPanel::activate(const ItemRef& item) {
    if (item.is_valid()) emit item_activated(item);
}

void ProjectPanel::set_project(const projects::Project& project, const Registry& registry, bool read_only,
                               const QString& why) {
    const QSet<QString> before = keys();
    const bool is_new = !has_project_;
    ItemRef wanted = selected();
    const int row = view_->currentIndex().row();
    const QModelIndex group = model_->index_of(wanted).parent();
    const ItemKind kind = wanted.kind;
    const ItemRef owner = wanted.owner();
    has_project_ = true;
    registry_ = &registry;
    read_only_ = read_only;
    why_read_only_ = why;
    settling_ = true;
    model_->set_read_only(read_only);
    model_->set_project(project, registry);
    view_->restore_folding(!filter_->text().isEmpty());
    if (follow_.is_valid()) wanted = follow_;
    follow_ = {};
    if (const ItemRef fresh = newest(before); select_new_ && !is_new && fresh.is_valid()) {
        wanted = fresh;
        select_new_ = false;
    } else if (group.isValid() && !model_->index_of(wanted).isValid()) {
        wanted = neighbour(owner, kind, row);
    }
    settling_ = false;
    select(wanted);
    announce();
    update_actions();
}

ItemRef ProjectPanel::newest(const QSet<QString>& before) const {
    for (const ItemRef& item : model_->items())
        if (!before.contains(item.key())) return item;
    return {};
}

ItemRef ProjectPanel::neighbour(const ItemRef& owner, ItemKind kind, int row) const {
    const bool within = kind == ItemKind::part || kind == ItemKind::light;
    const QModelIndex list = within ? model_->index_of(owner) : model_->group_index(kind);
    const int last = model_->rowCount(list) - 1;
    const ItemRef beside = last < 0 ? ItemRef() : model_->item(model_->index(std::min(row, last), 0, list));
    return beside.is_valid() ? beside : model_->item(list);
}

void ProjectPanel::clear() {
    has_project_ = false;
    model_->clear();
    announce();
    update_actions();
}

void ProjectPanel::set_current_experiment(const QString& id) {
    model_->set_current_experiment(id);
}

void ProjectPanel::set_stale(const QSet<QString>& experiments) {
    model_->set_stale(experiments);
}

void ProjectPanel::set_problems(const QHash<QString, QString>& problems) {
    model_->set_problems(problems);
}

QSet<QString> ProjectPanel::keys() const {
    QSet<QString> result;
    for (const ItemRef& item : model_->items()) result.insert(item.key());
    return result;
}

void ProjectPanel::select(const ItemRef& item) {
    const QModelIndex index = filter_->mapFromSource(model_->index_of(item));
    if (!index.isValid()) return;
    view_->setCurrentIndex(index);
    view_->scrollTo(index);
}

ItemRef ProjectPanel::selected() const {
    return model_->item(filter_->mapToSource(view_->currentIndex()));
}

void ProjectPanel::announce() {
    if (settling_) return;
    update_actions();
    const ItemRef now = selected();
    if (now == announced_) return;
    announced_ = now;
    emit item_selected(now);
}

void ProjectPanel::edit(const EditMaker& make, bool select_new) {
    select_new_ = select_new;
    emit gesture_finished();
    emit edit_wanted(make);
    select_new_ = false;
    follow_ = {};
}

void ProjectPanel::move_to(const ItemRef& item, int position) {
    // Parts and lights are known by their places, so the selection has to go along.
    if (item.index >= 0) follow_ = {item.kind, item.id, position};
    edit(makers::move(item, position));
}

void ProjectPanel::move_selected(int steps) {
    const ItemRef item = selected();
    const QModelIndex index = model_->index_of(item);
    const int position = index.row() + steps;
    if (position < 0 || position >= model_->rowCount(index.parent())) return;
    move_to(item, position);
}

void ProjectPanel::remove_selected() {
    edit(makers::remove(selected()));
}

void ProjectPanel::duplicate_selected() {
    const ItemRef item = selected();
    if (item.index >= 0) follow_ = {item.kind, item.id, item.index + 1};
    edit(makers::duplicate(item), item.index < 0);
}

void ProjectPanel::rename_selected() {
    view_->setFocus();
    view_->edit(view_->currentIndex().siblingAtColumn(ProjectModel::name_column));
}

}  // namespace ir::widgets
