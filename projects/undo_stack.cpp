#include "projects/undo_stack.h"

namespace ir::projects {

bool UndoStack::push(Project& project, EditPtr edit) {
    if (edit->changes_nothing()) return false;
    edit->apply(project);
    if (clean_ && *clean_ > position_) clean_.reset();  // the saved state can no longer be reached
    edits_.erase(edits_.begin() + static_cast<std::ptrdiff_t>(position_), edits_.end());
    if (merged_into_newest(*edit)) return true;
    edits_.push_back(std::move(edit));
    ++position_;
    gesture_open_ = true;
    if (edits_.size() > limit_) drop_oldest();
    return true;
}

bool UndoStack::merged_into_newest(const Edit& edit) {
    if (edits_.empty() || !gesture_open_ || edit.merge_key().empty()) return false;
    auto& newest = *edits_.back();
    if (newest.merge_key() != edit.merge_key() || !newest.absorb(edit)) return false;
    if (newest.changes_nothing()) {  // dragged back to where it began
        edits_.pop_back();
        --position_;
        gesture_open_ = false;
    }
    return true;
}

void UndoStack::drop_oldest() {
    edits_.erase(edits_.begin());
    --position_;
    if (clean_) clean_ = *clean_ == 0 ? std::nullopt : std::optional(*clean_ - 1);
}

void UndoStack::undo(Project& project) {
    if (!can_undo()) return;
    edits_[--position_]->revert(project);
    gesture_open_ = false;
}

void UndoStack::redo(Project& project) {
    if (!can_redo()) return;
    edits_[position_++]->apply(project);
    gesture_open_ = false;
}

std::string UndoStack::undo_label() const {
    return can_undo() ? edits_[position_ - 1]->label() : "";
}

std::string UndoStack::redo_label() const {
    return can_redo() ? edits_[position_]->label() : "";
}

std::vector<std::string> UndoStack::labels() const {
    std::vector<std::string> result;
    for (const auto& edit : edits_) result.push_back(edit->label());
    return result;
}

void UndoStack::set_clean() {
    clean_ = position_;
    gesture_open_ = false;
}

void UndoStack::clear() {
    edits_.clear();
    position_ = 0;
    clean_ = 0;
    gesture_open_ = false;
}

}  // namespace ir::projects
