#pragma once

#include "renderers/core/report.h"
#include "widgets/models/rows_model.h"

namespace ir::widgets {

/// What passes left in a traced pixel. Columns: pass, buffer, before, after. A row's key is its pass's place
/// and its buffer: "3:radiance". Rows that changed nothing are dim.
QStringList change_headings();
std::vector<Row> change_rows(const FrameReport& report);

}  // namespace ir::widgets
