#include "widgets/compare/significance.h"

#include <QRect>
#include <QStringList>
#include <algorithm>
#include <cmath>
#include <limits>

#include "renderers/image/channels.h"
#include "widgets/image/display.h"

namespace ir::widgets {
namespace {

int compared_channels(const Picture& picture) {
    return value_channels(picture.semantic, picture.image->channels);
}

double variance_at(const Picture& picture, QPoint pixel, int channel) {
    if (!has_variance(picture)) return 0;
    const Image& variance = *picture.variance;
    return variance.at(pixel.x(), pixel.y(), variance.channels == 1 ? 0 : channel);
}

QString list_text(const QStringList& numbers) {
    return numbers.size() == 1 ? numbers.front()
                               : QLatin1Char('(') + numbers.join(QStringLiteral(", ")) + QLatin1Char(')');
}

}  // namespace

bool has_variance(const Picture& picture) {
    if (!picture.has_image() || !picture.variance) return false;
    const Image &image = *picture.image, &variance = *picture.variance;
    return variance.width == image.width && variance.height == image.height &&
           (variance.channels == 1 || variance.channels >= compared_channels(picture));
}

double z_value(const Picture& a, const Picture& b, QPoint pixel, int channel) {
    const double difference = double(a.image->at(pixel.x(), pixel.y(), channel)) -
                              double(b.image->at(pixel.x(), pixel.y(), channel));
    const double variance = variance_at(a, pixel, channel) + variance_at(b, pixel, channel);
    if (variance > 0) return difference / std::sqrt(variance);
    if (difference == 0) return 0;
    return std::copysign(std::numeric_limits<double>::infinity(), difference);
}

QString significance_text(const Picture& a, const Picture& b, QPoint pixel) {
    if (!a.has_image() || !b.has_image() || a.size() != b.size() ||
        !QRect(QPoint(0, 0), a.size()).contains(pixel))
        return {};
    QStringList differences, ratios;
    const int channels = std::min(compared_channels(a), compared_channels(b));
    for (int c = 0; c < channels; ++c) {
        differences << short_number(double(a.image->at(pixel.x(), pixel.y(), c)) -
                                    double(b.image->at(pixel.x(), pixel.y(), c)));
        ratios << short_number(z_value(a, b, pixel, c));
    }
    return QStringLiteral("A − B = %1   z = %2").arg(list_text(differences), list_text(ratios));
}

}  // namespace ir::widgets
