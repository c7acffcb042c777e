#include "projects/edited_document.h"

#include <utility>

namespace ir::projects {

void EditedDocument::begin(Project project, LastKept last_kept) {
    project_ = std::move(project);
    last_kept_ = std::move(last_kept);
    forget_steps();
}

void EditedDocument::forget_steps() {
    undo_.clear();
    recorded_.clear();
}

bool EditedDocument::edit(EditPtr edit) {
    require_writable();
    if (!undo_.push(project_, std::move(edit))) return false;
    forget_named_anew();
    changed();
    return true;
}

void EditedDocument::undo() {
    undo_.undo(project_);
    undone();
}

void EditedDocument::redo() {
    undo_.redo(project_);
    undone();
}

void EditedDocument::undone() {
    record_missing_hashes(project_, recorded_);
    changed();
}

void EditedDocument::changed() {
    ++revision_;
    tell_last_kept(project_, last_kept_);
    has_changed();
}

/// A file that an edit names anew may have another content by now.
void EditedDocument::forget_named_anew() {
    if (recorded_.empty()) return;
    auto copy = project_;
    for (const auto& [source, hash] : record_missing_hashes(copy, recorded_)) recorded_.erase(source);
}

void EditedDocument::record_hashes(const ContentHashes& known) {
    recorded_.merge(record_missing_hashes(project_, known));
}

bool EditedDocument::set_last_kept(LastKept keys) {
    last_kept_ = std::move(keys);
    return tell_last_kept(project_, last_kept_);
}

}  // namespace ir::projects
