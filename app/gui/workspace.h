#pragma once

#include <QObject>
#include <array>

#include "app/gui/picture_alone.h"
#include "app/gui/picture_presenter.h"
#include "app/gui/picture_tools.h"
#include "app/gui/space_presenter.h"

namespace ir::gui {

/// Shows what ViewModel says in the panes of the views, and tells it what a person does there.
class Workspace : public QObject {
    Q_OBJECT
  public:
    Workspace(Session& session, LivePictures& live, Renderer& renderer, ImageLoader& images,
              KeptResults& kept, widgets::ImageView::Surface surface);

    ViewModel& views() { return views_; }
    PictureTools& tools() { return tools_; }
    widgets::ViewArea& area() { return *area_; }
    widgets::ViewPane* pane(int view) const { return panes_[std::size_t(view)]; }  ///< null: never open
    /// A small picture of a buffer for lists; null where there is none.
    QImage thumbnail(const widgets::ViewSource& source) const {
        return thumbnails_ ? thumbnails_(source) : QImage();
    }
    void set_thumbnails(std::function<QImage(const widgets::ViewSource&)> thumbnails) {
        thumbnails_ = std::move(thumbnails);
    }
    widgets::ViewPane& active_pane() const { return *pane(area_->active()); }

    void set_mode(widgets::ViewMode mode);  ///< of the active view
    // What the active view shows: A, or the difference.
    std::string display_key() const;
    std::shared_ptr<const widgets::Picture> display_picture() const;
    widgets::Display display() const;
    bool is_automatic() const;
    void choose_display(const widgets::Display& display);  ///< as far as it is another one

    /// A comparison of the document in the active view, and the active view as one.
    void open_comparison(const projects::Comparison& comparison);
    projects::Comparison as_comparison();

    /// No 3D picture and no difference is under way.
    bool is_settled() const;
    /// Why an open view does not show all that it is asked for, in one line; empty: it does, or will soon.
    QString missing(int view) const;

    void save(projects::Json& memory) const;
    void load(const projects::Json& memory);

    /// Pictures in the open views have other colours now.
    void show_displays();

  signals:
    /// A picture in the active view is new.
    void picture_shown();
    void cursor_moved(QPoint pixel);
    void picked(QPoint pixel);
    void explain_wanted(QPoint pixel);
    /// Of the picture in the active view.
    void menu_wanted(QPoint global_position);
    /// Of the active view.
    void export_values_wanted();

  private:
    widgets::ViewPane* make_pane(int view);
    void connect_pane(int view, widgets::ViewPane& pane);
    void connect_compare(int view, widgets::ViewPane& pane);
    void connect_table(int view, widgets::BufferTable& table);
    void update_view(int view);
    void update_header(int view);
    void update_shared(int view);
    void mark_said(int view);
    void update_table(int view);
    void update_camera(int view);
    void on_linked(bool linked);
    void swap(int view);

    Session& session_;
    LivePictures& live_;
    widgets::ImageView::Surface surface_;
    std::function<QImage(const widgets::ViewSource&)> thumbnails_;
    PictureTools tools_;
    std::array<widgets::ViewPane*, widgets::ViewArea::max_views> panes_{};
    widgets::ViewArea* area_;  ///< makes the first pane at once
    ViewModel views_;
    PictureAlone alone_;
    PicturePresenter pictures_;
    SpacePresenter spaces_;
};

}  // namespace ir::gui
