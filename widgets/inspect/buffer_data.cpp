#include "widgets/inspect/buffer_data.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <ostream>

#include "renderers/core/error.h"
#include "renderers/core/value.h"

namespace ir::widgets {
namespace {

constexpr std::size_t scalar_bytes = 4;
constexpr std::uint64_t between_looks = 1 << 16;  ///< elements between two looks at `cancelled`

std::string component_name(const Field& field, int component) {
    if (field.count == 1) return field.name;
    if (field.count <= 4) return field.name + '.' + "xyzw"[component];
    return field.name + '.' + std::to_string(component);
}

std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::size_t scalar_named(const std::string& name, const std::vector<BufferData::Scalar>& scalars) {
    if (name == "element") return scalars.size();
    const auto found =
        std::find_if(scalars.begin(), scalars.end(), [&](const auto& scalar) { return scalar.name == name; });
    if (found != scalars.end()) return std::size_t(found - scalars.begin());
    std::string known = "element";
    for (const auto& scalar : scalars) known += ", " + scalar.name;
    throw UsageError("there is no field '" + name + "'; there are " + known);
}

double number_from(const std::string& text) {
    if (text == "nan" || text == "NaN") return std::numeric_limits<double>::quiet_NaN();
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, problem] = std::from_chars(text.data(), end, value);
    if (text.empty() || problem != std::errc() || rest != end)
        throw UsageError("'" + text + "' is not a number; write for example: count > 3");
    return value;
}

}  // namespace

std::vector<BufferData::Scalar> BufferData::scalars() const {
    std::vector<Scalar> result;
    for (const Field& field : fields)
        for (int c = 0; c < field.count; ++c) result.push_back({component_name(field, c), field.type});
    return result;
}

std::size_t BufferData::stride() const {
    std::size_t count = 0;
    for (const Field& field : fields) count += std::size_t(std::max(field.count, 0));
    return count * scalar_bytes;
}

std::uint64_t BufferData::present() const {
    if (!bytes || stride() == 0) return 0;
    // Lists of elements hold 32-bit numbers; 64 MiB of bytes are far below.
    return std::min<std::uint64_t>({elements, bytes->size() / stride(), 0xffffffffu});
}

BufferReader::BufferReader(const BufferData& buffer)
    : bytes_(buffer.bytes), scalars_(buffer.scalars()), elements_(buffer.present()) {}

std::uint32_t BufferReader::bits(std::uint64_t element, std::size_t scalar) const {
    const std::byte* at = bytes_->data() + (element * scalars_.size() + scalar) * scalar_bytes;
    std::uint32_t result = 0;
    for (std::size_t i = 0; i < scalar_bytes; ++i) result |= std::to_integer<std::uint32_t>(at[i]) << (8 * i);
    return result;
}

double BufferReader::value(std::uint64_t element, std::size_t scalar) const {
    if (scalar >= scalars_.size()) return double(element);
    const std::uint32_t value = bits(element, scalar);
    switch (scalars_[scalar].type) {
        case FieldType::u32:
            return value;
        case FieldType::i32:
            return std::bit_cast<std::int32_t>(value);
        default:
            return std::bit_cast<float>(value);
    }
}

std::string BufferReader::text(std::uint64_t element, std::size_t scalar) const {
    if (scalar >= scalars_.size()) return std::to_string(element);
    const std::uint32_t value = bits(element, scalar);
    switch (scalars_[scalar].type) {
        case FieldType::u32:
            return std::to_string(value);
        case FieldType::i32:
            return std::to_string(std::bit_cast<std::int32_t>(value));
        default:
            return shortest_text(std::bit_cast<float>(value));
    }
}

bool BufferFilter::accepts(double x) const {
    const bool same = x == value || (std::isnan(x) && std::isnan(value));
    switch (operation) {
        case Operation::equal:
            return same;
        case Operation::not_equal:
            return !same;
        case Operation::less:
            return x < value;
        case Operation::at_most:
            return x <= value;
        case Operation::more:
            return x > value;
        default:
            return x >= value;
    }
}

BufferFilter parse_filter(const std::string& text, const std::vector<BufferData::Scalar>& scalars) {
    using Operation = BufferFilter::Operation;
    static const std::pair<const char*, Operation> operations[] = {
        {"==", Operation::equal},    {"!=", Operation::not_equal}, {"<=", Operation::at_most},
        {">=", Operation::at_least}, {"=", Operation::equal},      {"<", Operation::less},
        {">", Operation::more}};
    const auto at = text.find_first_of("=!<>");
    if (at != std::string::npos)
        for (const auto& [sign, operation] : operations) {
            if (text.compare(at, std::char_traits<char>::length(sign), sign) != 0) continue;
            const std::string right = text.substr(at + std::char_traits<char>::length(sign));
            BufferFilter filter;
            filter.scalar = scalar_named(trimmed(text.substr(0, at)), scalars);
            filter.operation = operation;
            filter.value = number_from(trimmed(right));
            // A buffer's floats are compared with the float that was typed: "x = 0.1" finds 0.1f.
            if (filter.scalar < scalars.size() && scalars[filter.scalar].type == FieldType::f32)
                filter.value = double(float(filter.value));
            return filter;
        }
    throw UsageError("a filter is a field, one of = != < <= > >= and a number, for example: count > 3");
}

ElementList filter_elements(const BufferReader& buffer, const BufferFilter& filter,
                            const std::atomic<bool>* cancelled) {
    ElementList result;
    for (std::uint64_t element = 0; element < buffer.elements(); ++element) {
        if (element % between_looks == 0 && cancelled && cancelled->load()) break;
        if (filter.accepts(buffer.value(element, filter.scalar))) result.push_back(std::uint32_t(element));
    }
    return result;
}

ElementList all_elements(const BufferReader& buffer) {
    ElementList result(buffer.elements());
    std::iota(result.begin(), result.end(), 0u);
    return result;
}

void sort_elements(const BufferReader& buffer, std::size_t scalar, bool descending, ElementList& elements) {
    struct Key {
        double value;
        std::uint32_t element;
    };
    std::vector<Key> keys;
    keys.reserve(elements.size());
    for (const std::uint32_t element : elements) keys.push_back({buffer.value(element, scalar), element});
    const auto end_of_numbers = std::stable_partition(keys.begin(), keys.end(),
                                                      [](const Key& key) { return !std::isnan(key.value); });
    std::sort(keys.begin(), end_of_numbers, [descending](const Key& a, const Key& b) {
        if (a.value != b.value) return descending ? a.value > b.value : a.value < b.value;
        return a.element < b.element;
    });
    std::transform(keys.begin(), keys.end(), elements.begin(), [](const Key& key) { return key.element; });
}

void to_csv(std::ostream& out, const BufferData& buffer, const ElementList* elements) {
    const BufferReader reader(buffer);
    out << "element";
    for (const auto& scalar : reader.scalars()) {
        const bool quote = scalar.name.find_first_of(",\"\n") != std::string::npos;
        std::string name;
        for (const char c : scalar.name) name += c == '"' ? std::string("\"\"") : std::string(1, c);
        out << ',' << (quote ? '"' + name + '"' : name);
    }
    out << '\n';
    const std::uint64_t count = elements ? elements->size() : reader.elements();
    for (std::uint64_t row = 0; row < count; ++row) {
        const std::uint64_t element = elements ? (*elements)[row] : row;
        out << element;
        for (std::size_t scalar = 0; scalar < reader.scalars().size(); ++scalar)
            out << ',' << reader.text(element, scalar);
        out << '\n';
    }
}

}  // namespace ir::widgets
