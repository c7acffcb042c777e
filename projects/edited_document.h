#pragma once

#include "projects/results.h"
#include "projects/scene_files.h"
#include "projects/undo_stack.h"

namespace ir::projects {

/// A document and the steps that made it: every change is an edit that can be undone.
class EditedDocument {
  public:
    explicit EditedDocument(const Registry& registry) : registry_(registry) {}
    virtual ~EditedDocument() = default;
    EditedDocument(const EditedDocument&) = delete;

    const Project& project() const { return project_; }
    const Registry& registry() const { return registry_; }

    /// Applies and remembers. Returns whether the document changed. Throws UsageError when read-only.
    bool edit(EditPtr edit);
    void end_gesture() { undo_.end_gesture(); }
    void undo();
    void redo();
    const UndoStack& undo_stack() const { return undo_; }
    bool is_dirty() const { return !undo_.is_clean() || begins_unsaved_; }

    /// What the index of the results says now; others keep results, too. No change of the document, and no
    /// matter of undo. Returns whether it was news.
    bool set_last_kept(LastKept keys);

  protected:
    virtual void require_writable() const = 0;
    virtual void has_changed() = 0;
    /// Anew as `project`; nothing before that can be undone to.
    void begin(Project project, LastKept last_kept = {});
    /// Gives sources without a recorded hash that of `known`; no step of undo. Without it nobody would notice
    /// later that a file changed.
    void record_hashes(const ContentHashes& known);
    /// Nothing before can be undone to.
    void forget_steps();
    std::size_t revision() const { return revision_; }  ///< rises with every change
    Project project_;
    UndoStack undo_;
    bool begins_unsaved_ = false;  ///< as it is before its first step, it was never saved

  private:
    void changed();
    void undone();
    void forget_named_anew();
    const Registry& registry_;
    LastKept last_kept_;
    ContentHashes recorded_;  ///< where nothing was: older states do not have it
    std::size_t revision_ = 0;
};

}  // namespace ir::projects
