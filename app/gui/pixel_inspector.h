#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QPoint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/gui/workspace.h"
#include "widgets/inspect/explain_panel.h"
#include "widgets/inspect/inspector_panel.h"

namespace ir::gui {

/// The pixel under the cursor, pinned pixels, and the pixel that is explained: asks the renderer for values
/// and for the method's explanations, and fills the panels with the answers.
class PixelInspector : public QObject {
    Q_OBJECT
  public:
    PixelInspector(Session& session, LivePictures& live, Renderer& renderer, Workspace& workspace);

    widgets::InspectorPanel& panel() { return *panel_; }
    widgets::ExplainPanel& explain_panel() { return *explain_; }

    /// Panels that are not seen ask for nothing.
    void set_visible(bool inspector, bool explain);
    void set_thumbnails_wanted(bool wanted);
    void pin(QPoint pixel);
    /// Under the cursor, else the marked one; of the main result, (-1, -1): none.
    QPoint pointed() const { return cursor_.x() >= 0 ? cursor_ : marked_; }
    bool says_none();  ///< whether no pixel is pointed at, which is then said
    void pin_cursor();
    /// Its number from 0 on; another pin that is there already takes its place.
    void move_pin(int number, QPoint pixel);
    void explain(QPoint pixel);
    void explain_cursor();
    void explain_nothing();
    const std::vector<QPoint>& pins() const { return pins_; }
    /// The explained pixel of the active experiment.
    std::optional<QPoint> explained() const;

    void save(projects::Json& memory) const;
    void load(const projects::Json& memory);

  signals:
    void pins_changed();
    void fly_wanted(int pin);  ///< number from 0 on
    void said(const QString& text);

  private:
    void update();
    void show_pins();
    void update_explain();
    void request();
    void send_wants();
    void on_probe(std::shared_ptr<const engine::ProbeResult> result);
    void show_readings(const engine::ProbeResult& result, bool with_cursor);
    void show_everything();
    std::string experiment() const;  ///< of the active view; empty: none
    /// What explains a pixel: outputs of the method, and what its shaders draw.
    struct Explaining {
        std::string key, label, doc;
        OutputKind kind = OutputKind::image;
    };
    std::vector<Explaining> explaining() const;
    std::vector<std::string> explaining_keys(bool spatial) const;

    Session& session_;
    LivePictures& live_;
    Renderer& renderer_;
    Workspace& workspace_;
    ViewModel& views_;
    widgets::InspectorPanel* panel_;
    widgets::ExplainPanel* explain_;
    QPoint cursor_{-1, -1}, marked_{-1, -1};
    std::vector<QPoint> pins_;
    std::set<std::string> computed_;  ///< buffers asked for one by one
    bool compute_all_ = false, thumbnails_ = false, inspector_shown_ = false, explain_shown_ = false;
    bool is_probing_ = false, probe_again_ = false;  ///< one probe at a time
    QElapsedTimer probed_since_;
    std::string probed_tag_;           ///< of the probe under way
    bool probed_with_cursor_ = false;  ///< its first pixel is the cursor's
    bool open_explanation_ = false;    ///< show it in space when its buffers are there
};

}  // namespace ir::gui
