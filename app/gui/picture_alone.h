#pragma once

#include <array>

#include "app/gui/view_model.h"

namespace ir::gui {

/// One of the pictures of a view, or a difference, as large as the view, until somebody goes back to all.
class PictureAlone {
  public:
    explicit PictureAlone(ViewModel& views) : views_(views) {}
    /// Both ends of a difference, or a picture, by their places in ViewRules::places().
    void show(int view, widgets::StagePair shown);
    bool is_shown(int view) const;
    void show_all(int view);
    void clear() { shown_ = {}; }
    /// Another mode is one of all pictures.
    widgets::ViewState in_mode(int view, widgets::ViewMode mode) const;

  private:
    struct Shown {
        widgets::ViewState all, alone;
    };
    ViewModel& views_;
    std::array<Shown, widgets::ViewArea::max_views> shown_;
};

}  // namespace ir::gui
