#pragma once

#include <QPoint>
#include <QSize>
#include <QString>
#include <memory>
#include <string>

#include "renderers/core/output.h"
#include "renderers/image/atlas.h"
#include "renderers/image/image.h"

namespace ir::widgets {

/// What a view shows: pixels and what they mean. Never changed once it is shared, so that views, workers and
/// the document may hold the same one; a change is another Picture, usually around the same pixels.
struct Picture {
    std::shared_ptr<const Image> image;  ///< null: there is none, and `note` says why
    std::shared_ptr<const Image> valid;  ///< one channel of the same size, above 0.5 where there is a value
    /// Of the same size: the variance of each value, per channel or one for all; null: unknown.
    std::shared_ptr<const Image> variance;
    bool awaits_variance = false;  ///< it will have one
    Semantic semantic = Semantic::generic;
    QString label, unit;
    QString note;                           ///< instead of an image: why there is none
    std::string colour_map;                 ///< empty: the semantic's own
    std::vector<Category> categories = {};  ///< where numbers, or colours, are names
    Atlas atlas;                            ///< levels and layers in one picture; empty: a plain image
    bool stale = false;                     ///< a newer one is being rendered
    /// What stands for the picture until it is there, "preview" or "coarse ¼": it is seen, and counts for
    /// nothing. Empty: the picture itself.
    QString draft;
    bool is_preview = false;  ///< of other values than the picture's, and shown in a way of its own
    std::string origin;       ///< whose computation it is a part of; empty: nobody knows

    bool operator==(const Picture&) const = default;  ///< of pixels the same object
    bool has_image() const { return image && !image->empty(); }
    QSize size() const { return has_image() ? QSize(image->width, image->height) : QSize(); }
};

std::shared_ptr<const Picture> make_picture(Image image, Semantic semantic, const QString& label = {},
                                            const QString& unit = {});
/// What is said in the place of what drafts do not have, such as metrics.
QString full_picture_awaited();
/// "valid pixels: 6273 of 9216", which numbers of the picture are of; empty: of all.
QString valid_pixels(std::size_t valid, std::size_t all);
std::shared_ptr<const Picture> make_note(const QString& note, const QString& label = {});

/// A pixel in terms of its tile: of a plain image level 0 and layer 0.
struct PicturePixel {
    int level = 0, layer = 0;
    QPoint pixel{-1, -1};  ///< within the tile; negative: outside, or in a gap between tiles
    bool operator==(const PicturePixel&) const = default;
};
PicturePixel locate(const Picture& picture, QPoint pixel);
/// "level 2", "slice 5", "slice 5 · level 2"; empty for a plain image.
QString tile_name(const Atlas& atlas, const AtlasTile& tile);
/// "x   12  y   40", in an atlas "level 2  x    3  y   10"; empty outside.
QString place_text(const Picture& picture, QPoint pixel);

}  // namespace ir::widgets
