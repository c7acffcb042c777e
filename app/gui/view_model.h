#pragma once

#include <QObject>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/display_memory.h"
#include "app/gui/view_rules.h"
#include "widgets/views/view_area.h"

namespace ir::gui {

/// What each view shows, as plain data, and what is therefore wanted of the experiments. What is shown in
/// the active view is worked on.
class ViewModel : public QObject {
    Q_OBJECT
  public:
    /// The area says which views are open and which one is active.
    ViewModel(Session& session, LivePictures& live, ImageLoader& images, KeptResults& kept,
              const widgets::ViewArea& area);

    PictureSource& pictures() { return pictures_; }
    const PictureSource& pictures() const { return pictures_; }
    const ViewRules& rules() const { return rules_; }
    const widgets::ViewState& state(int view) const { return states_[std::size_t(view)]; }
    std::vector<int> open_views() const { return area_.open_views(); }
    const widgets::ViewState& active_state() const { return state(area_.active()); }
    std::string shown_key() const;  ///< resource key of the active view's A
    std::vector<std::string> shown_experiments() const;

    /// Sets what a view shows; an owner or output that does not exist becomes one that does.
    void set_state(int view, widgets::ViewState state);
    // In the active view.
    void set_active_state(widgets::ViewState state) { set_state(area_.active(), std::move(state)); }
    void show_owner(const std::string& owner);
    void show_output(const std::string& key, int level = 0, int layer = 0);  ///< empty: the main result
    /// As B: the output that A shows if the owner has it, else its main result. A mode without B becomes side
    /// by side.
    void compare_with(const std::string& owner);
    void set_mode(widgets::ViewMode mode);

    /// Whether all views move, look and are coloured alike.
    bool linked() const { return linked_; }
    void set_linked(bool linked);
    /// How a buffer is shown in a view, by its key of ViewRules; null: nobody has chosen, automatic.
    const widgets::Display* chosen_display(const std::string& key, int view) const;
    /// Of what the active view shows; absent: automatic. What is as it was `before` is not chosen. While
    /// views are linked, exposure and tone map are those of all pictures of light.
    void choose_display(const std::optional<widgets::Display>& display,
                        const widgets::Display* before = nullptr);

    /// What a panel wants beside the views, by experiment; only of experiments that a view shows.
    void set_panel_wants(std::map<std::string, Want> wants, const std::string& panel = "inspector");
    void set_inspection(const std::string& experiment, const Inspection& inspection);
    const Inspection& inspection(const std::string& experiment) const;
    /// How far into the frame all pictures of an experiment look.
    void set_step(const std::string& experiment, const FrameStep& step);
    std::vector<widgets::SpaceSelector> selectors(const std::string& owner) const;

    void save(projects::Json& memory) const;
    /// Returns of how many views something is known. Nothing is refreshed before finish_loading().
    int load(const projects::Json& memory);
    void finish_loading();

  signals:
    /// A view shows something else, or what it shows has got further.
    void shown_changed(int view);
    /// Another view is active, or it shows something else.
    void active_changed();
    /// The pixel that is explained in a view is another one.
    void explained_changed(int view);
    void linked_changed(bool linked);
    void displays_changed();

  private:
    /// Mends and completes what the views show, after whatever may have changed it.
    void refresh();
    widgets::ViewState without_lost(int view) const;
    void on_active_changed();
    void on_picture(const std::string& id);
    void send_wants();
    int display_view(int view) const { return linked_ ? DisplayMemory::shared : view; }

    static constexpr std::size_t max_views = widgets::ViewArea::max_views;
    using States = std::array<widgets::ViewState, max_views>;
    Session& session_;
    LivePictures& live_;
    const widgets::ViewArea& area_;
    PictureSource pictures_;
    ViewRules rules_;
    States states_;
    States before_;  ///< what a view showed before another experiment came into it
    /// What a view showed of an experiment that was then gone, and what it shows instead.
    struct Gone {
        widgets::ViewState state, instead;
    };
    std::array<Gone, max_views> gone_;
    DisplayMemory displays_;
    std::map<std::string, std::map<std::string, Want>> panel_wants_;  ///< by panel
    std::map<std::string, Inspection> inspections_;
    std::map<std::string, FrameStep> steps_;
    bool linked_ = true, loading_ = false;
};

}  // namespace ir::gui
