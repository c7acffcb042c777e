#pragma once

#include <QPoint>

#include "app/gui/view_model.h"
#include "widgets/compare/view_link.h"

namespace ir::gui {

/// Shows pictures in views, with displays and marks.
class PicturePresenter {
  public:
    PicturePresenter(Session& session, ViewModel& views) : session_(session), views_(views) {}
    void set_linked(bool linked) { link_.set_linked(linked); }
    void update(int view, widgets::ViewPane& pane);
    void update_displays(int view, widgets::CompareView& compare);
    /// Once after pictures came by which others are exposed or coloured, too.
    bool take_shared_change();
    /// What is explained is marked, also when it was chosen elsewhere. A mark on that pixel already stays: on
    /// a coarser level several of its pixels are the same one.
    void mark_explained(int view, widgets::ViewPane& pane);
    /// Text beside the explained pixel; empty: none.
    void mark_said(int view, widgets::ViewPane& pane, const QString& text);
    /// The pixel of the main result of A's owner that a pixel of the picture under the cursor shows; (-1,
    /// -1): none.
    QPoint pointed_pixel_of_result(int view, const widgets::CompareView& compare, QPoint pixel) const;

  private:
    using PicturePtr = std::shared_ptr<const widgets::Picture>;
    PicturePtr with_meaning(int view, const widgets::ViewSource& source) const;
    void name_stages(int view, std::vector<PicturePtr>& pictures) const;
    void update_references(int view, widgets::CompareView& compare);
    widgets::Display display_of(const widgets::ViewSource& source, int view) const;
    double shared_exposure(int view, Semantic semantic) const;
    std::optional<widgets::Display> own_difference(int view) const;
    std::optional<widgets::Display> difference_display(int view) const;
    /// The pixel of a pane's picture that shows one of the main result, and that picture's size.
    std::pair<QPoint, QSize> shown_pixel(int view, widgets::ViewPane& pane, QPoint pixel) const;
    QPoint pixel_of_result(int view, const widgets::Picture* picture, QPoint pixel) const;

    /// What linked views share.
    struct Shared {
        std::map<Semantic, double> exposures;
        std::map<int, std::pair<double, double>> ranges;  ///< of differences, by view
        bool operator==(const Shared&) const = default;
    };

    Session& session_;
    ViewModel& views_;
    Shared shared_;
    std::array<widgets::CompareView*, widgets::ViewArea::max_views> compare_views_{};
    widgets::ViewLink link_;  ///< of the pictures of all views: those of equal size move together
};

}  // namespace ir::gui
