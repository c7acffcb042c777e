#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "widgets/compare/compare_mode.h"
#include "widgets/compare/pane_board.h"

class QKeyEvent;

namespace ir::widgets {

class DifferenceWorker;
class StageBar;
class ViewLink;

/// Shows a comparison: fills the panes that its mode asks for, has the differences computed, and turns what a
/// hand does into changes. Keys: 1 … 9 show a picture for as long as they are held (single, wipe, lens,
/// flip, difference) or choose two to be compared (stages; 0: none), Tab shows the next one (flip), X swaps A
/// and B, L links and unlinks.
class CompareView : public QWidget {
    Q_OBJECT
  public:
    using Mode = ComparedPictures::Mode;

    explicit CompareView(QWidget* parent = nullptr, ImageView::Surface surface = ImageView::Surface::best);

    const ComparedPictures& compared() const { return all_; }
    PaneBoard& panes() { return *panes_; }

    /// Zoom and place stay. Pictures that are the same object as before cost nothing.
    void set_pictures(std::vector<std::shared_ptr<const Picture>> pictures);
    /// One for each picture (missing ones are defaults).
    void set_displays(std::vector<Display> displays);
    void set_difference_display(std::optional<Display> display);
    void set_mode(Mode mode);
    void set_difference(DifferenceKind kind);
    void set_stage_pair(StagePair pair);
    /// One for each picture, as far as they are compared with them (null: none), and whether they may be.
    void set_references(bool exist, std::vector<std::shared_ptr<const Picture>> pictures);
    void set_wipe(double fraction);
    void set_noise_hint(const QString& hint);
    /// Of one picture; without it, of all.
    void set_camera(const CameraPose& pose, std::optional<int> picture = std::nullopt);

    /// Picture of the view that has (or last had) the keyboard.
    int active_picture() const;
    ImageView& active_view() { return panes_->pane(panes_->active()); }
    /// The only view of single, wipe, lens, flip and difference; the one of A otherwise.
    ImageView& main_view() { return panes_->pane(0); }
    /// Views of this mode in the order of the pictures.
    std::vector<ImageView*> views() const { return views_where(false); }
    /// Stages: those of the pictures in their order, and last that of the chosen pair.
    std::vector<ImageView*> difference_views() const { return views_where(true); }
    /// What the cursor was over last: a picture, a difference, or a note; null: nothing.
    std::shared_ptr<const Picture> pointed_picture() const;
    /// The difference of A and B that is shown; null without one (yet).
    std::shared_ptr<const Picture> difference_picture() const;
    /// How differences are shown at present.
    const Display& difference_display() const { return shown_difference_; }
    /// Where nobody says otherwise; absent: there is no difference (yet).
    std::optional<Display> own_difference_display() const;
    /// A worker is under way.
    bool is_computing() const;

  public slots:
    /// Exchanges A and B with all that belongs to them. The owner exchanges its own record when `swapped`
    /// comes.
    void swap();
    void set_linked(bool linked);
    /// Flip: the next picture stays on.
    void flip_next();

  signals:
    /// Pixel under the cursor and the picture by its place (-1: a difference); (-1, -1) outside.
    void cursor_moved(QPoint pixel, int picture);
    void picked_changed(QPoint pixel);
    void zoom_changed(double zoom);
    void transform_changed(const ir::widgets::ViewTransform& transform);
    /// While linked, the camera of all pictures; else of this one alone.
    void camera_moved(const ir::widgets::CameraPose& pose, int picture);
    void camera_gesture_finished(int picture);
    void activated(int picture);
    void menu_wanted(QPoint global_position);
    void explain_wanted(QPoint pixel);
    void swapped();
    void stage_pair_chosen(ir::widgets::StagePair pair);
    void linked_changed(bool linked);
    void wipe_moved(double fraction);
    void difference_shown();  ///< a new difference is on the screen

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;

  private:
    const CompareMode& rules() const { return CompareMode::of(all_.mode); }
    std::vector<ImageView*> views_where(bool row_difference) const;
    void connect_pane(ImageView* view, int pane);
    int camera_of(int pane) const;
    void camera_from(int pane, const CameraPose& pose);
    int picture_of(int pane, QPoint pixel) const;
    bool is_of_second(int pane, QPoint pixel) const;

    void refresh();
    void arrange();
    void request_differences();
    void show_difference(int slot);
    void fill(ImageView& view, const PaneContent& content, const QString& refusal);
    void fill_difference(ImageView& view, int slot);
    std::optional<Display> row_display() const;
    PaneBoard::Cell cell_of(int pane, QSize grid) const;
    QString number_of(int slot) const;
    QString tip_of(int slot) const;
    void relink();
    void update_bar();

    int held_by(const QKeyEvent& event) const;
    void hold(int picture);
    void choose_pair(StagePair pair);
    bool choose_by_key(const QKeyEvent& event);

    ComparedPictures all_;
    std::vector<PaneContent> contents_;  ///< of the panes that are shown
    Display shown_difference_;
    PaneBoard* panes_;
    ViewLink* link_;
    DifferenceWorker* worker_;
    StageBar* bar_;
    QPoint pointed_{-1, -1};
    int pointed_pane_ = 0;
};

}  // namespace ir::widgets
