#include <utility>

#include "projects/open_project.h"
#include "renderers/core/error.h"

namespace ir::projects {

/// The whole document becomes what a recovery holds.
class OpenProject::TakeRecovery final : public Edit {
  public:
    TakeRecovery(Project before, Project after, std::shared_ptr<TakenRecovery> taken)
        : Edit("Recover unsaved changes", ""),
          before_(std::move(before)),
          after_(std::move(after)),
          taken_(std::move(taken)) {}
    void apply(Project& project) override {
        exchange(project, before_, after_);
        taken_->is_held = true;
    }
    void revert(Project& project) override {
        exchange(project, after_, before_);
        taken_->is_held = false;
    }
    bool absorb(const Edit&) override { return false; }
    /// Even when both are equal: whether the recovery is held changes.
    bool changes_nothing() const override { return false; }

  private:
    static void exchange(Project& present, Project& left, const Project& entered) {
        left = std::exchange(present, entered);
    }
    Project before_, after_;
    std::shared_ptr<TakenRecovery> taken_;
};

void OpenProject::next_recovery() {
    recovery_.reset();
    if (older_recoveries_.empty()) return;
    recovery_ = std::move(older_recoveries_.back());
    older_recoveries_.pop_back();
}

void OpenProject::take_recovery() {
    if (!recovery_) return;
    auto taken = std::make_shared<TakenRecovery>(TakenRecovery{recovery_->file});
    edit(std::make_unique<TakeRecovery>(project_, recovery_->project, taken));
    end_gesture();
    taken_.push_back(std::move(taken));
    next_recovery();
    look_at_files();
    check_again();
}

void OpenProject::discard_recovery() {
    if (!recovery_) return;
    const auto file = recovery_->file;
    next_recovery();
    files_.remove(file);
}

/// What the document was made from. Those taken before that one were replaced by it and are only safe in
/// their files.
std::vector<std::filesystem::path> OpenProject::contained_recoveries() const {
    for (auto taken = taken_.rbegin(); taken != taken_.rend(); ++taken)
        if ((*taken)->is_held) return {(*taken)->file};
    return {};
}

/// What was taken over is saved now, or given up. What was undone again stays.
void OpenProject::forget_taken() {
    std::vector<std::shared_ptr<TakenRecovery>> undone;
    for (const auto& taken : std::exchange(taken_, {})) {
        if (!taken->is_held) {
            undone.push_back(taken);
            continue;
        }
        try {
            files_.remove(taken->file);
        } catch (const Error&) {
            // It will be offered again: better than losing it.
        }
    }
    taken_ = std::move(undone);
}

}  // namespace ir::projects
