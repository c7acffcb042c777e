#include "widgets/models/rows_model.h"

#include <QApplication>
#include <QColor>
#include <QFont>
#include <QIcon>
#include <QMimeData>
#include <QPixmap>

#include "widgets/models/heading.h"
#include "widgets/style/icons.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

constexpr int sign_size = 16;  // logical pixels

bool same_shape(const std::vector<Row>& a, const std::vector<Row>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i].key != b[i].key || !same_shape(a[i].children, b[i].children)) return false;
    return true;
}

}  // namespace

RowsModel::RowsModel(QStringList headings, QObject* parent)
    : QAbstractItemModel(parent), headings_(std::move(headings)) {}

void RowsModel::set_rows(std::vector<Row> rows) {
    if (same_shape(rows_, rows)) {
        rows_ = std::move(rows);
        // The places keep their addresses (indexes hold them); only what they point to is new.
        const auto relink = [](auto& self, Place& place, const std::vector<Row>& list) -> void {
            for (std::size_t i = 0; i < list.size(); ++i) {
                place.children[i]->row = &list[i];
                self(self, *place.children[i], list[i].children);
            }
        };
        relink(relink, root_, rows_);
        announce({});
        return;
    }
    beginResetModel();
    rows_ = std::move(rows);
    root_.children.clear();
    link(root_, rows_);
    endResetModel();
}

void RowsModel::link(Place& place, const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        auto child = std::make_unique<Place>();
        child->row = &row;
        child->parent = &place;
        child->number = int(place.children.size());
        link(*child, row.children);
        place.children.push_back(std::move(child));
    }
}

void RowsModel::announce(const QModelIndex& parent) {
    const int count = rowCount(parent);
    if (count == 0) return;
    emit dataChanged(index(0, 0, parent), index(count - 1, columnCount() - 1, parent));
    for (int i = 0; i < count; ++i) announce(index(i, 0, parent));
}

const RowsModel::Place& RowsModel::place_of(const QModelIndex& index) const {
    return index.isValid() ? *static_cast<const Place*>(index.internalPointer()) : root_;
}

QModelIndex RowsModel::index(int row, int column, const QModelIndex& parent) const {
    if (!hasIndex(row, column, parent)) return {};
    return createIndex(row, column, place_of(parent).children[std::size_t(row)].get());
}

QModelIndex RowsModel::parent(const QModelIndex& child) const {
    if (!child.isValid()) return {};
    Place* parent = place_of(child).parent;
    return parent == &root_ ? QModelIndex() : createIndex(parent->number, 0, parent);
}

int RowsModel::rowCount(const QModelIndex& parent) const {
    return parent.column() > 0 ? 0 : int(place_of(parent).children.size());
}

int RowsModel::columnCount(const QModelIndex&) const {
    return int(headings_.size());
}

Qt::ItemFlags RowsModel::flags(const QModelIndex& index) const {
    const auto flags = QAbstractItemModel::flags(index);
    return index.isValid() && !hasChildren(index.siblingAtColumn(0)) ? flags | Qt::ItemIsDragEnabled : flags;
}

QMimeData* RowsModel::mimeData(const QModelIndexList& indexes) const {
    auto* data = new QMimeData;
    if (!indexes.isEmpty())
        data->setData(QLatin1String(mime_type), indexes.front().data(key_role).toString().toUtf8());
    return data;
}

QVariant RowsModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) return {};
    const Row& row = *place_of(index).row;
    if (role == key_role) return QString::fromStdString(row.key);
    if (role == folded_role) return row.folded;
    if (std::size_t(index.column()) >= row.cells.size()) return {};
    const Cell& cell = row.cells[std::size_t(index.column())];
    switch (role) {
        case Qt::DisplayRole:
            return cell.text;
        case Qt::ToolTipRole:
            return cell.tooltip.isEmpty() ? QVariant() : picture_text(cell.picture) + cell.tooltip;
        case Qt::DecorationRole:
            if (!cell.picture.isNull()) return QIcon(QPixmap::fromImage(cell.picture));
            return cell.sign ? QVariant(icon(cell.sign).pixmap(QSize(sign_size, sign_size),
                                                               qApp->devicePixelRatio()))
                             : QVariant();
        case Qt::TextAlignmentRole:
            return int((cell.number ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
        case Qt::ForegroundRole:
            return row.dim ? QVariant(theme_colours().dim) : QVariant();
        case Qt::FontRole: {
            if (!row.strong) return {};
            QFont font;
            font.setBold(true);
            return font;
        }
        default:
            return {};
    }
}

QVariant RowsModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || section < 0 || section >= headings_.size()) return {};
    if (role == Qt::TextAlignmentRole) return heading_alignment(*this, section);
    return role == Qt::DisplayRole ? QVariant(headings_[section]) : QVariant();
}

QModelIndex RowsModel::index_of(const std::string& key) const {
    return find_below({}, key);
}

QModelIndex RowsModel::find_below(const QModelIndex& parent, const std::string& key) const {
    for (int i = 0; i < rowCount(parent); ++i) {
        const QModelIndex child = index(i, 0, parent);
        if (place_of(child).row->key == key) return child;
        const QModelIndex deeper = find_below(child, key);
        if (deeper.isValid()) return deeper;
    }
    return {};
}

}  // namespace ir::widgets
