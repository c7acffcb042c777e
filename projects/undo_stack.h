#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "projects/edits.h"

namespace ir::projects {

/// Undo and redo of one document.
class UndoStack {
  public:
    explicit UndoStack(std::size_t limit = 1000) : limit_(limit) {}

    /// Applies the edit and remembers it. Merges with the newest step when the merge keys are equal, no
    /// gesture ended in between and the newest step is not the saved state. Edits that change nothing are
    /// forgotten. Returns whether the document changed.
    bool push(Project& project, EditPtr edit);
    /// The user let go of the slider: the next edit starts a step of its own.
    void end_gesture() { gesture_open_ = false; }

    bool can_undo() const { return position_ > 0; }
    bool can_redo() const { return position_ < edits_.size(); }
    void undo(Project& project);  ///< nothing when there is nothing to undo
    void redo(Project& project);
    std::string undo_label() const;  ///< empty when there is nothing
    std::string redo_label() const;
    std::vector<std::string> labels() const;  ///< oldest first, redoable ones included
    std::size_t position() const { return position_; }

    void set_clean();  ///< the present state is the saved one
    bool is_clean() const { return clean_ && *clean_ == position_; }
    void clear();  ///< forgets all steps; the present state is clean

  private:
    bool merged_into_newest(const Edit& edit);
    void drop_oldest();
    std::vector<EditPtr> edits_;
    std::size_t position_ = 0, limit_;
    std::optional<std::size_t> clean_ = 0;
    bool gesture_open_ = false;
};

}  // namespace ir::projects
