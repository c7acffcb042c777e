#pragma once

#include <QObject>
#include <set>
#include <vector>

#include "projects/json.h"
#include "widgets/compare/pane_board.h"

namespace ir::gui {

/// What a drag in a picture does, and what is drawn over pictures: the same in all views.
class PictureTools : public QObject {
    Q_OBJECT
  public:
    using Tool = widgets::ImageView::Tool;

    /// Panes that have them, too, from now on.
    void add(widgets::PaneBoard& panes);

    Tool tool() const { return tool_; }
    void set_tool(Tool tool);
    /// Whether a hand has used it since the program began: pictures say how until then.
    bool is_known(Tool tool) const { return known_.count(tool) != 0; }
    void set_pixel_grid(bool on);
    void set_legend(bool on);
    void set_pins(std::vector<widgets::PinMark> pins);
    /// The rectangle that is measured, in all pictures of one size; empty: none.
    void set_region(QSize size, const QRect& region);
    QRect region(QSize size) const { return size == region_size_ ? region_ : QRect(); }
    QSize region_size() const { return region_size_; }  ///< of the pictures that it is in; empty: none
    /// The line whose values are plotted, likewise; null: none.
    void set_line(QSize size, const QLine& line);
    QLine line() const { return line_; }
    QSize line_size() const { return line_size_; }

    void save(projects::Json& memory) const;
    void load(const projects::Json& memory);

  signals:
    void tool_changed(ir::widgets::ImageView::Tool tool);
    void region_changed();
    void line_changed();
    void shape_drawn();  ///< a hand has drawn, moved or cleared one of them
    // As in widgets::LightTool, of any pane.
    void light_moved(const glm::dvec3& position);
    void light_turned(const glm::dvec3& direction);
    void light_gesture_finished(bool kept);

  private:
    void note_use();
    std::vector<widgets::PaneBoard*> boards_;
    Tool tool_ = Tool::inspect;
    std::set<Tool> known_;
    bool grid_ = true, legend_ = true;
    std::vector<widgets::PinMark> pins_;
    QSize region_size_;
    QRect region_;
    QSize line_size_;
    QLine line_;
};

}  // namespace ir::gui
