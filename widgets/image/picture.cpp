#include "widgets/image/picture.h"

#include <QCoreApplication>
#include <QRect>
#include <QStringList>
#include <algorithm>

namespace ir::widgets {
namespace {

QString translated(const char* text) {
    return QCoreApplication::translate("Picture", text);
}

bool several(const Atlas& atlas, int AtlasTile::*member) {
    return std::any_of(atlas.tiles.begin(), atlas.tiles.end(),
                       [&](const AtlasTile& tile) { return tile.*member != atlas.tiles.front().*member; });
}

}  // namespace

std::shared_ptr<const Picture> make_picture(Image image, Semantic semantic, const QString& label,
                                            const QString& unit) {
    Picture picture;
    picture.image = std::make_shared<const Image>(std::move(image));
    picture.semantic = semantic;
    picture.label = label;
    picture.unit = unit;
    return std::make_shared<const Picture>(std::move(picture));
}

std::shared_ptr<const Picture> make_note(const QString& note, const QString& label) {
    Picture picture;
    picture.note = note;
    picture.label = label;
    return std::make_shared<const Picture>(std::move(picture));
}

QString full_picture_awaited() {
    return translated("Waiting for the full picture …");
}

QString valid_pixels(std::size_t valid, std::size_t all) {
    return valid == all ? QString() : translated("valid pixels: %1 of %2").arg(valid).arg(all);
}

PicturePixel locate(const Picture& picture, QPoint pixel) {
    if (!picture.has_image() || !QRect(QPoint(0, 0), picture.size()).contains(pixel)) return {};
    if (picture.atlas.tiles.empty()) return {0, 0, pixel};
    const AtlasTile* tile = picture.atlas.tile_at(pixel.x(), pixel.y());
    if (!tile) return {};
    return {tile->level, tile->layer, pixel - QPoint(tile->x, tile->y)};
}

QString tile_name(const Atlas& atlas, const AtlasTile& tile) {
    QStringList parts;
    if (several(atlas, &AtlasTile::layer)) parts << translated("slice %1").arg(tile.layer);
    if (several(atlas, &AtlasTile::level)) parts << translated("level %1").arg(tile.level);
    return parts.join(QStringLiteral(" · "));
}

QString place_text(const Picture& picture, QPoint pixel) {
    const PicturePixel place = locate(picture, pixel);
    if (place.pixel.x() < 0) return {};
    const QString at = QStringLiteral("x %1  y %2").arg(place.pixel.x(), 4).arg(place.pixel.y(), 4);
    const AtlasTile* tile = picture.atlas.tile_at(pixel.x(), pixel.y());
    const QString name = tile ? tile_name(picture.atlas, *tile) : QString();
    return name.isEmpty() ? at : name + QStringLiteral("  ") + at;
}

}  // namespace ir::widgets
