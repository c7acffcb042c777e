#include "widgets/inspect/buffer_model.h"

#include <QColor>
#include <algorithm>
#include <cmath>
#include <limits>

#include "widgets/image/display.h"
#include "widgets/style/theme.h"

namespace ir::widgets {

BufferModel::BufferModel(QObject* parent) : QAbstractTableModel(parent), reader_(buffer_) {}

void BufferModel::set_buffer(BufferData buffer) {
    const bool same = buffer.fields == buffer_.fields && buffer.present() == buffer_.present();
    if (!same) beginResetModel();
    buffer_ = std::move(buffer);
    reader_ = BufferReader(buffer_);
    if (!same) {
        listed_.reset();
        endResetModel();
    } else if (rowCount() > 0 && columnCount() > 0) {
        emit dataChanged(index(0, 0), index(rowCount() - 1, columnCount() - 1));
    }
}

void BufferModel::set_listed(std::optional<ElementList> listed) {
    if (listed == listed_) return;
    beginResetModel();
    listed_ = std::move(listed);
    endResetModel();
}

qint64 BufferModel::element(int row) const {
    if (row < 0 || row >= rowCount()) return -1;
    return listed_ ? qint64((*listed_)[std::size_t(row)]) : row;
}

int BufferModel::row_of(qint64 element) const {
    if (element < 0) return -1;
    if (!listed_) return element < rowCount() ? int(element) : -1;
    const auto found = std::find(listed_->begin(), listed_->end(), std::uint32_t(element));
    return found == listed_->end() ? -1 : int(found - listed_->begin());
}

int BufferModel::rowCount(const QModelIndex& parent) const {
    if (parent.isValid()) return 0;
    const std::uint64_t rows = listed_ ? listed_->size() : reader_.elements();
    return int(std::min<std::uint64_t>(rows, std::numeric_limits<int>::max()));
}

int BufferModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : 1 + int(reader_.scalars().size());
}

/// Null: the number is an amount.
const Category* BufferModel::category(qint64 element, std::size_t scalar) const {
    const auto& names = categories_of(buffer_.categories, reader_.scalars()[scalar].name);
    if (names.empty()) return nullptr;
    const auto number = static_cast<float>(reader_.value(std::uint64_t(element), scalar));
    return category_at(&number, 1, names);
}

QVariant BufferModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) return {};
    const qint64 number = element(index.row());
    if (index.column() == 0) {
        if (role == Qt::DisplayRole || role == Qt::ToolTipRole) return QString::number(number);
        if (role == Qt::ForegroundRole) return theme_colours().dim;
        if (role == Qt::TextAlignmentRole) return int(Qt::AlignRight | Qt::AlignVCenter);
        return {};
    }
    const auto scalar = std::size_t(index.column() - 1);
    const bool whole = reader_.scalars()[scalar].type != FieldType::f32;
    const auto* name = category(number, scalar);
    switch (role) {
        case Qt::DisplayRole:
            if (name)
                return QStringLiteral("%1 %2").arg(name->value).arg(QString::fromStdString(name->label));
            if (!whole) return short_number(reader_.value(std::uint64_t(number), scalar));
            [[fallthrough]];
        case Qt::ToolTipRole:
            return QString::fromStdString(reader_.text(std::uint64_t(number), scalar));
        case Qt::TextAlignmentRole:
            return int((name ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
        case Qt::DecorationRole:
            return name ? QVariant(colour_of(*name)) : QVariant();
        case Qt::ForegroundRole: {
            const double value = reader_.value(std::uint64_t(number), scalar);
            if (std::isnan(value)) return theme_colours().nan;
            return std::isinf(value) ? QVariant(theme_colours().infinite) : QVariant();
        }
        default:
            return {};
    }
}

QVariant BufferModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || section < 0 || section >= columnCount()) return {};
    if (role == Qt::TextAlignmentRole) return int(Qt::AlignRight | Qt::AlignVCenter);
    if (section == 0) {
        if (role == Qt::DisplayRole) return tr("#");
        return role == Qt::ToolTipRole ? QVariant(tr("Number of the element; “element” in filters"))
                                       : QVariant();
    }
    const auto& scalar = reader_.scalars()[std::size_t(section - 1)];
    const QString name = QString::fromStdString(scalar.name);
    if (role == Qt::DisplayRole) return name;
    if (role != Qt::ToolTipRole) return {};
    const QString type = scalar.type == FieldType::f32   ? tr("float, 32 bits")
                         : scalar.type == FieldType::i32 ? tr("integer, 32 bits")
                                                         : tr("unsigned integer, 32 bits");
    return tr("%1: %2. Click to sort.").arg(name, type);
}

}  // namespace ir::widgets
