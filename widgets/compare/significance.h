#pragma once

#include <QPoint>
#include <QString>

#include "renderers/image/difference.h"
#include "widgets/image/picture.h"

namespace ir::widgets {

/// Whether a picture of the same size comes with its variance.
bool has_variance(const Picture& picture);

/// (a - b) / √(variance of a + variance of b) of one channel; a picture without variance counts as exact.
/// Infinite where something differs that has no noise at all, 0 where nothing differs.
double z_value(const Picture& a, const Picture& b, QPoint pixel, int channel);

/// "A − B = 0.012   z = 4.1" of a pixel that both have, channel by channel.
QString significance_text(const Picture& a, const Picture& b, QPoint pixel);

}  // namespace ir::widgets
