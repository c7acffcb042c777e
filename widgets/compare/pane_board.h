#pragma once

#include <QScrollArea>
#include <vector>

#include "widgets/image/image_view.h"

class QPainter;

namespace ir::widgets {

/// The panes of a comparison: where they are, on the screen and in a snapshot, what stands under them, and
/// what they have in common. Scrolls where they would be too small to be seen.
class PaneBoard : public QScrollArea {
    Q_OBJECT
  public:
    struct Cell {
        QPointF place;            ///< the upper left corner, in columns and rows
        bool difference = false;  ///< it shows one
        QString caption, tip;     ///< below the pane, where there are captions
        bool clickable = false, chosen = false;
    };

    explicit PaneBoard(QWidget* parent = nullptr, ImageView::Surface surface = ImageView::Surface::best);

    /// Shows the first panes, one for each cell; the pictures are in them already. One alone fills the board.
    void arrange(std::vector<Cell> cells, QSize grid, bool captions);
    /// Made when it is first asked for.
    ImageView& pane(int index);
    /// Of a pane where all fit without scrolling; empty: they do not.
    QSize size_in(QSize grid, bool captions) const;
    int pane_count() const { return int(panes_.size()); }
    /// Those that are shown.
    const std::vector<Cell>& cells() const { return cells_; }
    /// The pane that has, or last had, the keyboard.
    int active() const { return active_; }

    void set_tool(ImageView::Tool tool);
    /// Whether one of the panes says how the tool is used: the one under the cursor, or that was last.
    void set_hinted(bool on);
    void set_pixel_grid(bool on);
    void set_legend(bool on);
    void set_fly_speed(double metres_per_second);
    void set_pins(std::vector<PinMark> pins);
    /// A pixel of pictures of that size. Those of which it is a reduced or enlarged one mark the pixel that
    /// covers its centre; without a size all mark the same one.
    void set_picked(QPoint pixel, QSize size = {});
    /// A rectangle of all pictures that have this size; empty: none.
    void set_region(QSize size, const QRect& region);
    void set_line(QSize size, const QLine& line);  ///< likewise; null: none
    /// A light of a pane's scene, with handles; none: no handles.
    void set_light(int pane, const std::optional<PlacedLight>& light) { this->pane(pane).set_light(light); }

    /// What stands in the place of a picture or difference that is not shown; empty: all are.
    QString missing() const;
    /// What stands under each pane.
    QStringList captions() const;
    /// Where the caption of a pane is, in the widget that holds the panes.
    QRect caption_rect(int pane) const;
    /// All panes as they are arranged, also what is scrolled away.
    QImage snapshot(bool overlays, bool legend,
                    ImageView::SnapshotScale scale = ImageView::SnapshotScale::as_shown) const;

  signals:
    void resized();
    void pane_made(ir::widgets::ImageView* view, int pane);
    void activated(int pane);
    void caption_pressed(int pane);
    void picked_changed(int pane, QPoint pixel);
    /// Drawn, moved, resized or (empty) cleared by hand, in pictures of that size.
    void region_changed(QSize size, QRect region);
    void line_changed(QSize size, QLine line);
    void shape_drawn();  ///< the hand let go of one of them
    void tool_changed(ir::widgets::ImageView::Tool tool);
    void tool_used();  ///< a hand has drawn or cleared a shape, or moved the camera
    // As in LightTool, of any pane.
    void light_moved(const glm::dvec3& position);
    void light_turned(const glm::dvec3& direction);
    void light_gesture_finished(bool kept);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

  private:
    void place_panes();
    void paint();
    void paint_captions(QPainter& painter) const;
    int caption_line() const;
    int caption_height() const;
    int caption_at(QPoint point) const;
    QRect cell_rect(int pane) const;
    void update_legends();
    void update_marks();
    void update_hints();

    ImageView::Surface surface_;
    QWidget* sheet_;
    std::vector<ImageView*> panes_;  ///< those after the cells are hidden
    std::vector<Cell> cells_;
    QSize grid_{1, 1};
    bool captions_ = false, legend_ = false, pixel_grid_ = true, is_hinted_ = true;
    ImageView::Tool tool_ = ImageView::Tool::inspect;
    double fly_speed_ = 1;
    std::vector<PinMark> pins_;
    QPoint picked_{-1, -1};
    QSize picked_size_, region_size_, line_size_;
    QRect region_;
    QLine line_;
    int active_ = 0, pointed_ = 0;
};

}  // namespace ir::widgets
