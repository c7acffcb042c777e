#pragma once

#include <QAbstractTableModel>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderers/core/report.h"

namespace ir::widgets {

/// The elements of a buffer as they lie in memory: little-endian scalars of four bytes, tightly packed.
/// Copies share the bytes.
struct BufferData {
    std::vector<Field> fields;
    std::uint64_t elements = 0;                           ///< in the buffer
    std::shared_ptr<const std::vector<std::byte>> bytes;  ///< of the first elements

    /// One scalar of an element: where its column's title comes from.
    struct Scalar {
        std::string name;  ///< "position.x", "weights.5", "count"
        FieldType type = FieldType::f32;
    };
    std::vector<Scalar> scalars() const;
    std::size_t stride() const;  ///< bytes
    /// Elements that are there: less than `elements` when only the first part was sent.
    std::uint64_t present() const;
    /// All of u32, i32 and f32 fit a double without loss.
    double value(std::uint64_t element, std::size_t scalar) const;
    /// Shortest text that reads back as the same number; "nan", "inf", "-inf".
    std::string text(std::uint64_t element, std::size_t scalar) const;
};

/// One comparison: "position.x > 0.5".
struct BufferFilter {
    enum class Operation { equal, not_equal, less, at_most, more, at_least };
    std::size_t scalar = 0;
    Operation operation = Operation::equal;
    double value = 0;
    bool accepts(double x) const;
};

/// Reads "field op number" with op one of = == != < <= > >=; "nan" and "inf" are numbers. Throws UsageError.
BufferFilter parse_filter(const std::string& text, const std::vector<BufferData::Scalar>& scalars);

/// Numbers of the elements that a filter accepts, in order; stops early once `cancelled`.
std::vector<std::uint32_t> filter_elements(const BufferData& buffer, const BufferFilter& filter,
                                           const std::atomic<bool>* cancelled = nullptr);
/// The elements (all that are present without a list) in ascending order of a scalar, NaN last; stable.
std::vector<std::uint32_t> sort_elements(const BufferData& buffer, std::size_t scalar, bool descending,
                                         std::vector<std::uint32_t> elements);

/// Comma-separated, a header line first ("element,position.x,…"), floats with the digits that read back as
/// the same number. Without a list all elements that are present.
void to_csv(std::ostream& out, const BufferData& buffer,
            const std::vector<std::uint32_t>* elements = nullptr);

/// A row an element, a column a scalar after the element's number. Keeps a share of the bytes, copies
/// nothing.
class BufferModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    using QAbstractTableModel::QAbstractTableModel;
    void set_buffer(BufferData buffer);
    const BufferData& buffer() const { return buffer_; }
    /// Which elements are listed, in which order; none: all in order.
    void set_listed(std::optional<std::vector<std::uint32_t>> listed);
    const std::optional<std::vector<std::uint32_t>>& listed() const { return listed_; }
    qint64 element(int row) const;
    /// -1 when it is not listed.
    int row_of(qint64 element) const;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  private:
    BufferData buffer_;
    std::vector<BufferData::Scalar> scalars_;
    std::optional<std::vector<std::uint32_t>> listed_;
};

}  // namespace ir::widgets
