#pragma once

#include <string>
#include <utility>
#include <vector>

#include "projects/edits.h"

namespace ir::projects {

/// Edits that are built on what those before them leave, and are one step of undo together.
class EditSteps {
  public:
    explicit EditSteps(const Project& project) : after_(project) {}
    const Project& after() const { return after_; }
    /// Null, or one that changes nothing, is no step.
    void add(EditPtr edit) {
        if (!edit || edit->changes_nothing()) return;
        edit->apply(after_);
        steps_.push_back(std::move(edit));
    }
    /// Null without a step.
    EditPtr as_one(const std::string& label) {
        return steps_.empty() ? nullptr : edits::group(label, std::move(steps_));
    }

  private:
    Project after_;
    std::vector<EditPtr> steps_;
};

}  // namespace ir::projects
