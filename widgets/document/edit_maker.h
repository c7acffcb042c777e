#pragma once

#include <functional>
#include <string>
#include <utility>

#include "projects/edit_kinds.h"
#include "projects/edits.h"
#include "projects/text.h"
#include "projects/validate.h"

namespace ir::widgets {

/// Makes an edit against the document as it is when it is called. Throws UsageError with one line where a
/// value is not allowed; then nothing has changed.
using EditMaker = std::function<projects::EditPtr(const projects::Project&)>;

/// An edit of one field of an item: checked, named after the field, merging with others of that field only.
/// `merges` false makes every call a step of its own.
template <class Item, class Mutate>
EditMaker field_edit(std::string id, std::string field, Mutate mutate, bool merges = true) {
    return [id = std::move(id), field = std::move(field), mutate = std::move(mutate),
            merges](const projects::Project& project) {
        Item item = projects::edits::item_of<Item>(project, id);
        mutate(item);
        projects::validate(item);
        const std::string word = projects::edits::ListOf<Item>::word;
        return projects::edits::replace(
            project, item,
            "Change " + field + " of " + word + " '" + projects::printable(item.name, 40) + "'",
            merges ? word + ":" + id + ":" + field : "");
    };
}

}  // namespace ir::widgets
