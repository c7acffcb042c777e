#pragma once

#include <functional>

#include "projects/edits.h"

namespace ir::widgets {

/// Makes an edit against the document as it is when it is called. Throws UsageError with one line where a
/// value is not allowed; then nothing has changed.
using EditMaker = std::function<projects::EditPtr(const projects::Project&)>;

}  // namespace ir::widgets
