#include "renderers/core/category.h"

#include <algorithm>

namespace ir {

const std::vector<Category>& categories_of(const std::vector<Categories>& lists, const std::string& field) {
    static const std::vector<Category> none;
    const auto found =
        std::find_if(lists.begin(), lists.end(), [&](const auto& list) { return list.field == field; });
    return found == lists.end() ? none : found->values;
}

std::string category_label(const std::vector<Category>& categories, double number) {
    for (const auto& category : categories)
        if (category.value == number) return category.label;
    return {};
}

std::string category_doc(const Categories& categories) {
    std::string text = categories.field;
    for (const auto& category : categories.values) {
        text += &category == &categories.values.front() ? (text.empty() ? "" : ": ") : ", ";
        text += std::to_string(category.value) + " " + category.label;
    }
    return text + ".";
}

}  // namespace ir
