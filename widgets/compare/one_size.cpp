#include "widgets/compare/one_size.h"

#include <QCoreApplication>

#include "renderers/image/enlarge.h"

namespace ir::widgets {
namespace {

bool is_smaller(const Picture& picture, const Picture& other) {
    return picture.size().width() < other.size().width();
}

std::shared_ptr<const Image> enlarged(const std::shared_ptr<const Image>& image, QSize size) {
    if (!image || image->empty()) return image;
    return std::make_shared<const Image>(ir::enlarged(*image, size.width(), size.height()));
}

}  // namespace

bool have_difference(const Picture& a, const Picture& b) {
    if (!a.has_image() || !b.has_image() || !a.draft.isEmpty() || !b.draft.isEmpty()) return false;
    if (a.size() == b.size()) return true;
    const QSize small = is_smaller(a, b) ? a.size() : b.size(),
                large = is_smaller(a, b) ? b.size() : a.size();
    return !a.origin.empty() && a.origin == b.origin && a.atlas.tiles.empty() && b.atlas.tiles.empty() &&
           is_reduced(small.width(), small.height(), large.width(), large.height());
}

std::shared_ptr<const Picture> at_size(const std::shared_ptr<const Picture>& picture, QSize size) {
    if (picture->size() == size) return picture;
    auto result = *picture;
    for (auto* image : {&result.image, &result.valid, &result.variance}) *image = enlarged(*image, size);
    return std::make_shared<const Picture>(std::move(result));
}

std::pair<std::shared_ptr<const Picture>, std::shared_ptr<const Picture>> at_one_size(
    const std::shared_ptr<const Picture>& a, const std::shared_ptr<const Picture>& b) {
    if (!have_difference(*a, *b)) return {a, b};
    const QSize size = a->size().expandedTo(b->size());
    return {at_size(a, size), at_size(b, size)};
}

QPoint pixel_at_size(QPoint pixel, QSize from, QSize to) {
    const auto along = [](int at, int before, int after) {
        return int((2 * qint64(at) + 1) * after / (2 * qint64(before)));
    };
    return {along(pixel.x(), from.width(), to.width()), along(pixel.y(), from.height(), to.height())};
}

QString size_text(const Picture& picture) {
    return QStringLiteral("%1×%2").arg(picture.size().width()).arg(picture.size().height());
}

QString name_at_size(const QString& name, const Picture& picture, const Picture& other) {
    return is_smaller(picture, other) ? QStringLiteral("%1 (%2)").arg(name, size_text(picture)) : name;
}

QString size_rule(const QString& name_a, const Picture& a, const QString& name_b, const Picture& b) {
    if (a.size() == b.size()) return {};
    const bool first = is_smaller(a, b);
    return QCoreApplication::translate("CompareView",
                                       "%1 has %2 pixels, %3 has %4. Each pixel of %3 is compared with the "
                                       "texel of %1 that covers its centre.")
        .arg(first ? name_a : name_b, size_text(first ? a : b), first ? name_b : name_a,
             size_text(first ? b : a));
}

}  // namespace ir::widgets
