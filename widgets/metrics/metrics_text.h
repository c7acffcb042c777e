#pragma once

#include <QString>

#include "widgets/metrics/metrics_worker.h"

namespace ir::widgets {

/// "16384 pixels compared, 12 skipped".
QString pixels_text(const MetricResult& result);

/// The numbers of a pair as aligned lines, which say what was compared.
QString as_text(const MetricsResult& result);
/// "metric,image,rectangle" and a line a metric, with the digits that read back as the same number; the third
/// column only with a rectangle. Of several pairs two columns before them say which.
QString as_csv(const std::vector<const MetricsResult*>& results);

}  // namespace ir::widgets
