#pragma once

#include <QObject>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "app/gui/display_memory.h"
#include "app/gui/picture_source.h"
#include "widgets/compare/view_link.h"
#include "widgets/views/view_area.h"
#include "widgets/views/view_pane.h"

namespace ir::gui {

/// The views: what each of them shows, what is therefore wanted of the experiments, and the pictures on their
/// way back. All by kind of output; it knows no method.
class Workspace : public QObject {
    Q_OBJECT
  public:
    Workspace(Session& session, LivePictures& live, Renderer& renderer, ImageLoader& images,
              KeptResults& kept, widgets::ImageView::Surface surface);

    widgets::ViewArea& area() { return *area_; }
    widgets::ViewPane* pane(int view) const { return panes_[std::size_t(view)]; }  ///< null: never open
    widgets::ViewPane& active_pane() const { return *pane(area_->active()); }
    const widgets::ViewState& state(int view) const { return states_[std::size_t(view)]; }
    const widgets::ViewState& active_state() const { return state(area_->active()); }
    /// Sets what a view shows; an owner or output that does not exist becomes one that does.
    void set_state(int view, widgets::ViewState state);
    PictureSource& pictures() { return pictures_; }

    // In the active view.
    void show_output(const std::string& key, int level = 0, int layer = 0);  ///< empty: the main result
    void step_output(int step);
    void show_owner(const std::string& owner);
    /// As B: the output that A shows if the owner has it, else its main result. A mode without B becomes side
    /// by side.
    void compare_with(const std::string& owner);
    void set_mode(widgets::ViewMode mode);
    void show_stages();  ///< the chain that the method names, in a row
    void swap();
    std::string shown_key() const;  ///< resource key of A
    /// Key and picture whose display the active view shows: A's, or the difference's.
    std::string display_key();
    std::shared_ptr<const widgets::Picture> display_picture() const;
    widgets::Display display() const;
    bool is_automatic();
    void choose_display(const widgets::Display& display);
    void choose_automatic();

    /// Puts buffers that stand in space into views, those of each space (widgets::Space) into one: one that
    /// shows it already, else another than the active one.
    void show_in_space(const std::string& owner, const std::vector<std::string>& keys);
    /// An output in another view than the active one, which stays as it is.
    void show_beside(const std::string& owner, const std::string& key);

    bool linked() const { return linked_; }
    void set_linked(bool linked);
    void set_tool(widgets::ImageView::Tool tool);
    widgets::ImageView::Tool tool() const { return tool_; }
    void set_pixel_grid(bool on);
    void set_legend(bool on);
    void set_pins(std::vector<widgets::PinMark> pins);
    /// The rectangle that is measured, in all pictures of one size; empty: none.
    void set_region(QSize size, const QRect& region);
    QRect region(QSize size) const { return size == region_size_ ? region_ : QRect(); }

    /// What a panel wants beside the views, by experiment; only of experiments that a view shows.
    void set_panel_wants(std::map<std::string, Want> wants, const std::string& panel = "inspector");
    void set_inspection(const std::string& experiment, const Inspection& inspection);
    const Inspection& inspection(const std::string& experiment) const;
    std::vector<widgets::SpaceSelector> selectors(const std::string& owner) const;

    /// A comparison of the document in the active view, and the active view as one.
    void open_comparison(const projects::Comparison& comparison);
    projects::Comparison as_comparison();

    /// No 3D picture and no difference is under way.
    bool is_settled() const;
    /// Why an open view does not show all that it is asked for, in one line; empty: it does, or will soon.
    QString missing(int view) const;

    void save(projects::Json& memory) const;
    void load(const projects::Json& memory);

  signals:
    /// Another view is active, or it shows something else.
    void active_changed();
    /// A picture in the active view is new.
    void picture_shown();
    void cursor_moved(QPoint pixel);
    void picked(QPoint pixel);
    void explain_wanted(QPoint pixel);
    /// Of the active view.
    void export_values_wanted();
    void linked_changed(bool linked);
    void region_changed();
    void tool_changed(ir::widgets::ImageView::Tool tool);

  private:
    // workspace.cpp
    widgets::ViewPane* make_pane(int view);
    void connect_pane(int view, widgets::ViewPane& pane);
    void update_all();
    void update_view(int view);
    void update_header(int view);
    void update_camera(int view);
    void send_wants();
    void on_active_changed();
    void on_picture(const std::string& id);
    std::vector<std::string> shown_experiments() const;
    bool shows(int view, const std::string& owner) const;

    // workspace_state.cpp
    widgets::ViewState without_lost(int view) const;
    widgets::ViewState completed(widgets::ViewState state) const;
    widgets::ViewSource another_source(const widgets::ViewSource& a) const;
    std::vector<widgets::ViewSource> sources(const widgets::ViewState& state) const;
    std::vector<std::pair<widgets::ViewSource, QString>> candidates(const widgets::ViewState& state) const;
    widgets::ViewPane::Content content_of(const widgets::ViewState& state) const;
    Want want_of(const widgets::ViewState& state, const std::string& owner) const;

    // workspace_stages.cpp
    void complete_stages(widgets::ViewState& state) const;
    bool compares_reference(const widgets::ViewState& state) const;
    void name_stages(int view, std::vector<std::shared_ptr<const widgets::Picture>>& pictures) const;
    void update_reference(int view);
    QString missing_stages(const widgets::ViewState& state) const;

    // workspace_pictures.cpp
    widgets::ViewSource meaning_of(const widgets::ViewState& state, const widgets::ViewSource& source);
    std::string difference_key_of(const widgets::ViewState& state);
    /// The picture that is shown already where the other one says the same: it is not prepared, drawn and
    /// compared anew.
    static std::shared_ptr<const widgets::Picture> unless_equal(
        const std::shared_ptr<const widgets::Picture>& shown,
        const std::shared_ptr<const widgets::Picture>& picture);
    void update_pictures(int view);
    void update_displays(int view);
    widgets::Display display_of(const widgets::ViewSource& source, int view);
    std::string display_key_of(const widgets::ViewSource& source) const;
    void link_views();
    void connect_table(int view, widgets::BufferTable& table);
    void update_table(int view);

    // workspace_pixels.cpp
    /// The pixel of the main result of A's owner that a pixel of a picture in the view shows; (-1, -1): none.
    QPoint pixel_of_result(int view, const widgets::Picture* picture, QPoint pixel) const;
    QPoint pointed_pixel_of_result(int view, QPoint pixel) const;
    QSize main_size(const std::string& owner) const;  ///< of the main result; empty: not known
    void mark_explained(int view);

    // workspace_beside.cpp
    bool shows_explanation(const widgets::ViewState& state, const std::string& owner) const;
    /// Where something of `owner` is shown that must not cover what is looked at.
    int view_beside(const std::string& owner, const std::set<int>& filled,
                    const std::function<bool(const widgets::ViewState&)>& is_fit);

    // workspace_space.cpp
    void connect_space(int view, widgets::SpacePane& space);
    void update_space(int view);
    void request_space(int view, const widgets::SpaceScene& scene, QSize device_px, int oversampling);
    std::optional<widgets::BufferReader> values_of(int view, int layer) const;
    QString hover_text(int view, int layer, qint64 element) const;
    void choose_items(int view, int layer, qint64 element);
    void on_scene_view(std::shared_ptr<const engine::SceneViewResult> result);
    std::vector<widgets::AvailableBuffer> spatial_buffers(const std::string& owner) const;

    Session& session_;
    LivePictures& live_;
    Renderer& renderer_;
    PictureSource pictures_;
    widgets::ImageView::Surface surface_;
    std::array<widgets::ViewState, widgets::ViewArea::most_views> states_;
    /// What a view showed before another experiment came into it.
    std::array<widgets::ViewState, widgets::ViewArea::most_views> before_;
    /// What a view showed of an experiment that was then gone, and what it shows instead.
    struct Gone {
        widgets::ViewState state, instead;
    };
    std::array<Gone, widgets::ViewArea::most_views> gone_;
    std::array<widgets::ViewPane*, widgets::ViewArea::most_views> panes_{};
    /// 3D pictures of a view: what the newest was drawn from, whose they are, and which requests of that
    /// owner were sent and answered.
    struct Drawing {
        std::weak_ptr<const engine::LiveResult> result;
        std::string owner;
        std::uint64_t first_serial = 0, newest_serial = 0, answered_serial = 0;
        bool is_under_way() const { return answered_serial < newest_serial; }
    };
    std::array<Drawing, widgets::ViewArea::most_views> drawings_;
    widgets::ViewArea* area_ = nullptr;
    widgets::ViewLink link_;
    DisplayMemory displays_;
    std::vector<widgets::PinMark> pins_;
    std::map<std::string, std::map<std::string, Want>> panel_wants_;  ///< by panel
    QSize region_size_;
    QRect region_;
    std::map<std::string, Inspection> inspections_;
    bool linked_ = true, grid_ = true, legend_ = true, loading_ = false;
    widgets::ImageView::Tool tool_ = widgets::ImageView::Tool::inspect;
};

}  // namespace ir::gui
