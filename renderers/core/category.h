#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ir {

/// sRGB-encoded.
using Tint = std::array<std::uint8_t, 3>;

/// Colours that are told apart with any colour vision, also on grey.  [Okabe08]
namespace tints {
inline constexpr Tint orange{230, 159, 0}, sky{86, 180, 233}, green{0, 158, 115}, yellow{240, 228, 66},
    blue{0, 114, 178}, vermilion{213, 94, 0}, purple{204, 121, 167}, grey{150, 150, 150}, dark{70, 70, 70};
}  // namespace tints

/// A whole number that names something, such as what became of a ray, and is no amount.
struct Category {
    int value = 0;
    std::string label;  ///< "hit", "below the surface"
    Tint colour = tints::grey;
    bool operator==(const Category&) const = default;
};

/// What the numbers of one field of a buffer's element mean. Colours, legends, tooltips, tables and documents
/// take it from here. Numbers that are not listed are drawn nearly black.
struct Categories {
    std::string field;  ///< empty: an image's own numbers; of a colour image the key to its colours
    std::vector<Category> values;  ///< ascending
    bool operator==(const Categories&) const = default;
};

/// Those of a field; empty where its numbers are amounts.
const std::vector<Category>& categories_of(const std::vector<Categories>& lists, const std::string& field);

/// "hit along the direction"; empty for a number without a name.
std::string category_label(const std::vector<Category>& categories, double number);

/// "role: 0 none, 1 the point's own."
std::string category_doc(const Categories& categories);

}  // namespace ir
