#pragma once

#include <utility>

#include "widgets/image/picture.h"

/// Pictures of one computation may have sizes of their own, such as stages that work at half the size. They
/// are compared at the larger one's size: each of its pixels with the texel of the smaller one that covers
/// the pixel's centre. Pictures of different computations are to be rendered at one size instead.
namespace ir::widgets {

/// Whether there is a difference of them: equal sizes, or of one origin and one of them the other one
/// reduced. Drafts have none.
bool have_difference(const Picture& a, const Picture& b);

/// The picture, enlarged by the rule above to a size that it is not larger than, with its mask and variance.
std::shared_ptr<const Picture> at_size(const std::shared_ptr<const Picture>& picture, QSize size);

/// Both at the larger one's size where there is a difference of them; else as they are.
std::pair<std::shared_ptr<const Picture>, std::shared_ptr<const Picture>> at_one_size(
    const std::shared_ptr<const Picture>& a, const std::shared_ptr<const Picture>& b);

/// Where a pixel of pictures of one size is in those of another: the one that covers its centre.
QPoint pixel_at_size(QPoint pixel, QSize from, QSize to);

/// "192×108".
QString size_text(const Picture& picture);
/// The name with its size where the picture is the smaller of the two: "A (96×54)".
QString name_at_size(const QString& name, const Picture& picture, const Picture& other);
/// The rule for these two, in words; empty where sizes are equal.
QString size_rule(const QString& name_a, const Picture& a, const QString& name_b, const Picture& b);

}  // namespace ir::widgets
