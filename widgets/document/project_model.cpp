#include "widgets/document/project_model.h"

#include <QColor>
#include <QFont>
#include <QMimeData>

#include "widgets/document/project_nodes.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

const QString mime_type = QStringLiteral("application/x-interreflect-item");

bool same_shape(const ProjectModel::Node& a, const ProjectModel::Node& b) {
    if (a.item != b.item || a.group != b.group || a.children.size() != b.children.size()) return false;
    for (std::size_t i = 0; i < a.children.size(); ++i)
        if (!same_shape(*a.children[i], *b.children[i])) return false;
    return true;
}

/// Takes over what is shown; the nodes stay, because indexes point to them.
void take_texts(ProjectModel::Node& to, const ProjectModel::Node& from) {
    to.name = from.name;
    to.detail = from.detail;
    to.tooltip = from.tooltip;
    to.icon = from.icon;
    for (std::size_t i = 0; i < to.children.size(); ++i) take_texts(*to.children[i], *from.children[i]);
}

const ProjectModel::Node* find_node(const ProjectModel::Node& below, const ItemRef& item) {
    for (const auto& child : below.children) {
        if (child->item == item) return child.get();
        if (const auto* deeper = find_node(*child, item)) return deeper;
    }
    return nullptr;
}

void collect(const ProjectModel::Node& below, std::vector<ItemRef>& items) {
    for (const auto& child : below.children) {
        if (child->item.is_valid()) items.push_back(child->item);
        collect(*child, items);
    }
}

}  // namespace

ProjectModel::ProjectModel(QObject* parent) : QAbstractItemModel(parent), root_(std::make_unique<Node>()) {}

void ProjectModel::set_project(const projects::Project& project, const Registry& registry) {
    auto fresh = project_nodes(project, registry);
    if (same_shape(*root_, *fresh)) {
        take_texts(*root_, *fresh);
        announce(*root_);
        return;
    }
    beginResetModel();
    root_ = std::move(fresh);
    endResetModel();
}

void ProjectModel::clear() {
    beginResetModel();
    root_ = std::make_unique<Node>();
    endResetModel();
}

void ProjectModel::announce(const Node& node) {
    if (node.children.empty()) return;
    const Node* last = node.children.back().get();
    emit dataChanged(index_at(node.children.front().get()), index_at(last, column_count - 1));
    for (const auto& child : node.children) announce(*child);
}

void ProjectModel::set_read_only(bool read_only) {
    read_only_ = read_only;
}

void ProjectModel::set_current_experiment(const QString& id) {
    current_ = id;
    announce(*root_);
}

void ProjectModel::set_stale(const QSet<QString>& experiments) {
    stale_ = experiments;
    announce(*root_);
}

void ProjectModel::set_problems(const QHash<QString, QString>& problems) {
    problems_ = problems;
    announce(*root_);
}

ProjectModel::Node* ProjectModel::node_of(const QModelIndex& index) const {
    return index.isValid() ? static_cast<Node*>(index.internalPointer()) : root_.get();
}

QModelIndex ProjectModel::index_at(const Node* node, int column) const {
    return node && node != root_.get() ? createIndex(node->row, column, node) : QModelIndex();
}

QModelIndex ProjectModel::index_of(const ItemRef& item) const {
    return item.is_valid() ? index_at(find_node(*root_, item)) : QModelIndex();
}

QModelIndex ProjectModel::group_index(ItemKind kind) const {
    for (const auto& child : root_->children)
        if (child->group == kind) return index_at(child.get());
    return {};
}

ItemRef ProjectModel::item(const QModelIndex& index) const {
    return index.isValid() ? node_of(index)->item : ItemRef();
}

ItemKind ProjectModel::kind(const QModelIndex& index) const {
    if (!index.isValid()) return ItemKind::none;
    const Node& node = *node_of(index);
    return node.item.is_valid() ? node.item.kind : node.group;
}

std::vector<ItemRef> ProjectModel::items() const {
    std::vector<ItemRef> result;
    collect(*root_, result);
    return result;
}

QModelIndex ProjectModel::index(int row, int column, const QModelIndex& parent) const {
    if (!hasIndex(row, column, parent)) return {};
    return createIndex(row, column, node_of(parent)->children[std::size_t(row)].get());
}

QModelIndex ProjectModel::parent(const QModelIndex& child) const {
    return child.isValid() ? index_at(node_of(child)->parent) : QModelIndex();
}

int ProjectModel::rowCount(const QModelIndex& parent) const {
    return parent.column() > 0 ? 0 : int(node_of(parent)->children.size());
}

int ProjectModel::columnCount(const QModelIndex&) const {
    return column_count;
}

bool ProjectModel::is_stale(const Node& node) const {
    return node.item.kind == ItemKind::experiment && stale_.contains(node.item.id);
}

QString ProjectModel::problem_of(const Node& node) const {
    return node.item.is_valid() ? problems_.value(node.item.key()) : QString();
}

QString ProjectModel::tooltip(const Node& node) const {
    QString text = node.tooltip;
    const auto before = [&](const QString& line) {
        text = QStringLiteral("<p><b>%1</b></p>").arg(line.toHtmlEscaped()) + text;
    };
    if (is_stale(node)) before(tr("Its kept result is stale: it would render differently now."));
    if (const QString problem = problem_of(node); !problem.isEmpty()) before(problem);
    if (node.item.kind == ItemKind::experiment && node.item.id == current_)
        before(tr("This experiment is shown."));
    return text;
}

QVariant ProjectModel::name_data(const Node& node, int role) const {
    const bool is_current = node.item.kind == ItemKind::experiment && node.item.id == current_;
    switch (role) {
        case Qt::DisplayRole:
        case Qt::EditRole:
            return node.name;
        case Qt::DecorationRole:
            if (!problem_of(node).isEmpty()) return icon("warning");
            return node.icon ? QVariant(icon(node.icon)) : QVariant();
        case Qt::FontRole: {
            QFont font;
            font.setBold(is_current || node.group != ItemKind::none);
            const bool is_hint = !node.item.is_valid() && node.group == ItemKind::none;
            font.setItalic(is_hint);
            if (is_hint) font.setPointSizeF(font.pointSizeF() * 0.9);  // the whole line in a narrow dock
            return font;
        }
        default:
            return {};
    }
}

QVariant ProjectModel::detail_data(const Node& node, int role) const {
    const QString problem = problem_of(node);
    const bool troubled = !problem.isEmpty() || is_stale(node);
    switch (role) {
        case Qt::DisplayRole:
            if (!problem.isEmpty()) return problem;
            return is_stale(node) ? tr("stale · %1").arg(node.detail) : node.detail;
        case Qt::ForegroundRole:
            return troubled ? theme_colours().warning : theme_colours().dim;
        default:
            return {};
    }
}

QVariant ProjectModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) return {};
    const Node& node = *node_of(index);
    const bool is_hint = !node.item.is_valid() && node.group == ItemKind::none;
    switch (role) {
        case key_role:
            return node.item.is_valid() ? node.item.key() : QStringLiteral("group:%1").arg(int(node.group));
        case kind_role:
            return int(kind(index));
        case is_group_role:
            return node.group != ItemKind::none;
        case Qt::ToolTipRole:
            return tooltip(node);
        case Qt::ForegroundRole:
            if (is_hint) return theme_colours().dim;
            break;
        default:
            break;
    }
    return index.column() == name_column ? name_data(node, role) : detail_data(node, role);
}

QVariant ProjectModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
    return section == name_column ? tr("Item") : tr("Details");
}

Qt::ItemFlags ProjectModel::flags(const QModelIndex& index) const {
    if (!index.isValid()) return Qt::NoItemFlags;
    const Node& node = *node_of(index);
    const ItemKind item = node.item.kind;
    if (item == ItemKind::none && node.group == ItemKind::none) return Qt::NoItemFlags;
    Qt::ItemFlags result = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
    const bool has_name = item != ItemKind::none && item != ItemKind::part && item != ItemKind::light;
    if (read_only_) return result;
    if (has_name && index.column() == name_column) result |= Qt::ItemIsEditable;
    if (item != ItemKind::none && item != ItemKind::project) result |= Qt::ItemIsDragEnabled;
    if (!node.children.empty()) result |= Qt::ItemIsDropEnabled;
    return result;
}

bool ProjectModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    const QString name = value.toString().trimmed();
    if (role != Qt::EditRole || !(flags(index) & Qt::ItemIsEditable)) return false;
    if (name == node_of(index)->name) return false;
    emit rename_wanted(node_of(index)->item, name);
    return true;
}

Qt::DropActions ProjectModel::supportedDropActions() const {
    return Qt::MoveAction;
}

QStringList ProjectModel::mimeTypes() const {
    return {mime_type};
}

QMimeData* ProjectModel::mimeData(const QModelIndexList& indexes) const {
    if (indexes.isEmpty()) return nullptr;
    auto* data = new QMimeData;
    data->setData(mime_type, item(indexes.front()).key().toUtf8());
    return data;
}

bool ProjectModel::canDropMimeData(const QMimeData* data, Qt::DropAction action, int row, int,
                                   const QModelIndex& parent) const {
    if (!data || read_only_ || action != Qt::MoveAction || row < 0) return false;
    const QModelIndex moved = index_of(ItemRef::from_key(QString::fromUtf8(data->data(mime_type))));
    return moved.isValid() && moved.parent() == parent.siblingAtColumn(0);
}

bool ProjectModel::dropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                                const QModelIndex& parent) {
    if (!canDropMimeData(data, action, row, column, parent)) return false;
    const ItemRef moved = ItemRef::from_key(QString::fromUtf8(data->data(mime_type)));
    const int from = index_of(moved).row();
    emit move_wanted(moved, row > from ? row - 1 : row);
    return true;
}

}  // namespace ir::widgets
