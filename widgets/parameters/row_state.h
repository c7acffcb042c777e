#pragma once

#include <QString>
#include <vector>

#include "renderers/core/parameter.h"
#include "widgets/style/number_text.h"

namespace ir::widgets {

/// Everything that a row of the parameter panel shows, worked out from descriptions and values alone.
struct RowState {
    bool enabled = true;
    bool changed = false;  ///< differs from the default: bold label, reset button
    QString tooltip;       ///< doc, key, range, default, citation; why it is disabled
};
RowState row_state(const ParameterDescription& parameter, const std::vector<ParameterDescription>& all,
                   const Settings& settings);

/// Limits of the slider: the soft range within the hard one. Empty (min == max) when there is none.
Range slider_range(const ParameterDescription& parameter);
/// Whether the slider's steps are ratios: for positive ranges of two decades and more.
bool is_logarithmic(const Range& range);
/// Slider position 0 … 1 and back.
double slider_position(const Range& range, double value);
double slider_value(const Range& range, double position);
/// The label, with the unit where that is too long to stand behind the number in a narrow field.
QString label_text(const ParameterDescription& parameter);
/// What stands behind the number in the field: the unit that the label does not name, or nothing.
QString suffix_text(const ParameterDescription& parameter, double value = 2);
/// The value as people read it: choice labels, units.
QString value_text(const ParameterDescription& parameter, const Value& value);

}  // namespace ir::widgets
