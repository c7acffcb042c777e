#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
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
    std::vector<Categories> categories = {};              ///< of fields whose numbers are names

    /// One scalar of an element, a column of the table.
    struct Scalar {
        std::string name;  ///< "position.x", "weights.5", "count"
        FieldType type = FieldType::f32;
        bool operator==(const Scalar&) const = default;
    };
    std::vector<Scalar> scalars() const;
    std::size_t stride() const;  ///< bytes of an element
    /// Elements that are there: fewer than `elements` when only the first part was sent.
    std::uint64_t present() const;
};

/// Reads scalars of a buffer. Cheap to copy; keeps a share of the bytes.
class BufferReader {
  public:
    explicit BufferReader(const BufferData& buffer);
    std::uint64_t elements() const { return elements_; }
    const std::vector<BufferData::Scalar>& scalars() const { return scalars_; }
    /// All of u32, i32 and f32 fit a double without loss.
    double value(std::uint64_t element, std::size_t scalar) const;
    /// Shortest text that reads back as the same number; "nan", "inf", "-inf".
    std::string text(std::uint64_t element, std::size_t scalar) const;

  private:
    std::uint32_t bits(std::uint64_t element, std::size_t scalar) const;
    std::shared_ptr<const std::vector<std::byte>> bytes_;
    std::vector<BufferData::Scalar> scalars_;
    std::uint64_t elements_ = 0;
};

/// One comparison: "position.x > 0.5".
struct BufferFilter {
    enum class Operation { equal, not_equal, less, at_most, more, at_least };
    std::size_t scalar = 0;
    Operation operation = Operation::equal;
    double value = 0;
    bool accepts(double x) const;  ///< = nan and != nan ask whether it is a number
    bool operator==(const BufferFilter&) const = default;
};

/// Reads "field op number" with op one of = == != < <= > >=; "nan", "inf" and "-inf" are numbers, "element"
/// is the element's number (scalar == scalars.size()). Throws UsageError.
BufferFilter parse_filter(const std::string& text, const std::vector<BufferData::Scalar>& scalars);

using ElementList = std::vector<std::uint32_t>;

/// Numbers of the elements that a filter accepts, in order; returns early once `cancelled`.
ElementList filter_elements(const BufferReader& buffer, const BufferFilter& filter,
                            const std::atomic<bool>* cancelled = nullptr);
/// All elements that are present, in order.
ElementList all_elements(const BufferReader& buffer);
/// In the order of a scalar, equal ones by their number, NaN last in either direction.
void sort_elements(const BufferReader& buffer, std::size_t scalar, bool descending, ElementList& elements);

/// Comma-separated, a header line first ("element,position.x,…"), floats with the digits that read back as
/// the same number. Without a list all elements that are present.
void to_csv(std::ostream& out, const BufferData& buffer, const ElementList* elements = nullptr);

}  // namespace ir::widgets
