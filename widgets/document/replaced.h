#pragma once

#include <string>

#include "projects/edit_kinds.h"
#include "projects/text.h"
#include "projects/validate.h"
#include "renderers/core/error.h"

namespace ir::widgets::makers {

/// A step of its own: "LABEL 'NAME'".
template <class Item>
projects::EditPtr replaced(const projects::Project& project, const Item& item, const std::string& label) {
    projects::validate(item);
    return projects::edits::replace(project, item, label + " '" + projects::printable(item.name, 40) + "'",
                                    "");
}

/// Throws UsageError where a part or light is gone.
inline std::size_t checked_index(int index, std::size_t count, const char* word) {
    if (index < 0 || std::size_t(index) >= count)
        throw UsageError(std::string("there is no such ") + word + " any more");
    return std::size_t(index);
}

}  // namespace ir::widgets::makers
