#pragma once

#include <QAbstractTableModel>
#include <optional>

#include "widgets/inspect/buffer_data.h"

namespace ir::widgets {

/// A row an element, a column a scalar after the element's number. Keeps a share of the bytes, copies
/// nothing.
class BufferModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    explicit BufferModel(QObject* parent = nullptr);
    /// Elements of the same fields and count replace the old in place; what is listed stays only then.
    void set_buffer(BufferData buffer);
    const BufferData& buffer() const { return buffer_; }
    const BufferReader& reader() const { return reader_; }
    /// Which elements are listed, in which order; none: all in order.
    void set_listed(std::optional<ElementList> listed);
    const std::optional<ElementList>& listed() const { return listed_; }
    qint64 element(int row) const;
    /// -1 when it is not listed.
    int row_of(qint64 element) const;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  private:
    const Category* category(qint64 element, std::size_t scalar) const;
    BufferData buffer_;
    BufferReader reader_;
    std::optional<ElementList> listed_;
};

}  // namespace ir::widgets
