#include "app/gui/card_picture.h"

#include <QBuffer>
#include <algorithm>
#include <cstdlib>
#include <vector>

namespace ir::gui {
namespace {

/// Pixels across, bytes that its file may have, and quality of JPEG in percent.
constexpr int card_width = 400, max_card_bytes = 60'000, card_quality = 88;

/// By row: how much neighbours in it and below it differ.
std::vector<double> detail_of_rows(const QImage& picture) {
    std::vector<double> detail(std::size_t(picture.height()), 0.0);
    for (int y = 0; y + 1 < picture.height(); ++y)
        for (int x = 0; x + 1 < picture.width(); ++x) {
            const int here = qGray(picture.pixel(x, y));
            detail[std::size_t(y)] += std::abs(qGray(picture.pixel(x + 1, y)) - here) +
                                      std::abs(qGray(picture.pixel(x, y + 1)) - here);
        }
    return detail;
}

/// Of the rows that are kept, the first; in the middle where all are alike.
int first_row(const QImage& picture, int kept) {
    const auto detail = detail_of_rows(picture);
    const int middle = (picture.height() - kept) / 2;
    const auto sum_from = [&](int row) {
        double sum = 0;
        for (int y = row; y < row + kept; ++y) sum += detail[std::size_t(y)];
        return sum;
    };
    int best = middle;
    double most = 1.1 * sum_from(middle);  // not for a little
    for (int row = 0; row + kept <= picture.height(); ++row)
        if (const double sum = sum_from(row); sum > most) most = sum, best = row;
    return best;
}

}  // namespace

QImage picture_of(widgets::ViewPane& pane) {
    switch (pane.content()) {
        case widgets::ViewPane::Content::table:
            return {};
        case widgets::ViewPane::Content::picture:
            if (pane.compare().compared().mode == widgets::ViewMode::stages) return pane.snapshot(false);
            return pane.compare().main_view().snapshot(false, false,
                                                       widgets::ImageView::SnapshotScale::picture_pixels);
        default:
            return pane.snapshot(false);
    }
}

QImage with_shape(const QImage& picture, QSize size) {
    const auto small = picture.scaled(size, Qt::KeepAspectRatioByExpanding, Qt::SmoothTransformation);
    const int left = (small.width() - size.width()) / 2;
    const int top = small.height() > size.height() ? first_row(small, size.height()) : 0;
    return small.copy(QRect(QPoint(left, top), size));
}

QByteArray card_of(Workspace& workspace, bool is_set_up) {
    QImage picture;
    for (const int view : workspace.area().open_views()) {
        auto* pane = workspace.pane(view);
        const auto shown = pane ? picture_of(*pane) : QImage();
        if (shown.isNull()) continue;
        const bool is_plain = pane->content() == widgets::ViewPane::Content::picture;
        if (picture.isNull() || !is_plain) picture = shown;
        if (!is_set_up || !is_plain) break;
    }
    QByteArray bytes;
    for (int width = card_width; !picture.isNull() && width > 32; width = width * 7 / 8) {
        bytes.clear();
        QBuffer buffer(&bytes);
        with_shape(picture, {width, width * 9 / 16}).save(&buffer, "JPEG", card_quality);
        if (bytes.size() <= max_card_bytes) break;
    }
    return bytes;
}

}  // namespace ir::gui
