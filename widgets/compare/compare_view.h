#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "renderers/image/difference.h"
#include "widgets/compare/stage_pair.h"
#include "widgets/image/image_view.h"

class QPainter;
class QScrollArea;

namespace ir::widgets {

class DifferenceWorker;
class StageBar;
class ViewLink;

/// Two or more pictures of equal size against each other. The first is A, the second B; further ones take
/// part in flip, side by side and stages. Keys: 1 … 9 show a picture for as long as they are held (single,
/// wipe, flip, difference) or choose two to be compared (stages; 0: none), Tab shows the next one (flip), X
/// swaps A and B, L links and unlinks.
class CompareView : public QWidget {
    Q_OBJECT
  public:
    enum class Mode { single, side_by_side, wipe, flip, difference, stages };
    Q_ENUM(Mode)

    explicit CompareView(QWidget* parent = nullptr, ImageView::Surface surface = ImageView::Surface::best);
    ~CompareView() override;

    /// Zoom and place stay. Pictures that are the same object as before cost nothing.
    void set_pictures(std::vector<std::shared_ptr<const Picture>> pictures);
    /// One for each picture (missing ones are defaults). While linked, pictures of A's kind (semantic, unit
    /// and channels) are shown with A's, so that equal colours mean equal values.
    void set_displays(std::vector<Display> displays);
    /// How differences are shown; none: from the kind and the values (`display_for_difference`).
    void set_difference_display(std::optional<Display> display);
    void set_mode(Mode mode);
    void set_difference(DifferenceKind kind);
    /// Stages: the two that are compared beside the row.
    void set_stage_pair(StagePair pair);
    /// Stages: whether they may be compared with a reference, and its picture, null while nobody asked for
    /// it.
    void set_reference(bool exists, std::shared_ptr<const Picture> picture);
    /// The divider, 0 … 1 of the picture's width.
    void set_wipe(double fraction);
    void set_legend(bool on);
    void set_pixel_grid(bool on);
    void set_tool(ImageView::Tool tool);
    void set_camera(const CameraPose& pose);
    void set_camera(int picture, const CameraPose& pose);
    void set_fly_speed(double metres_per_second);
    /// A pixel of pictures of that size. Those of which it is a reduced or enlarged one mark the pixel that
    /// covers its centre; without a size all mark the same one.
    void set_picked(QPoint pixel, QSize size = {});
    void set_pins(std::vector<PinMark> pins);
    /// A rectangle of all pictures that have this size; empty: none.
    void set_region(QSize size, const QRect& region);
    /// What the refusal of a significance without variances goes on with: which pictures have one.
    void set_noise_hint(const QString& hint);

    Mode mode() const { return mode_; }
    DifferenceKind difference_kind() const { return kind_; }
    const std::vector<std::shared_ptr<const Picture>>& pictures() const { return pictures_; }
    StagePair stage_pair() const { return pair_; }
    const std::shared_ptr<const Picture>& reference() const { return reference_; }
    /// The display that a picture is shown with: its own, or A's while linked.
    Display shown_display(int picture) const;
    bool is_linked() const;
    double wipe() const { return wipe_; }
    /// Picture of the view that has (or last had) the keyboard.
    int active_picture() const;
    /// The difference of A and B that is shown; null without one (yet).
    std::shared_ptr<const Picture> difference_picture() const;
    /// How differences are shown at present.
    const Display& difference_display() const;
    /// Why the pictures cannot be compared in this mode; empty: they can.
    QString refusal() const;
    /// What stands in the place of a picture or difference that is not shown; empty: all are.
    QString missing() const;
    /// What the cursor was over last: a picture, a difference, or a note; null: nothing.
    std::shared_ptr<const Picture> pointed_picture() const;
    /// What is said of a pixel of the difference beside its value; empty: nothing.
    QString difference_text(QPoint pixel) const;

    /// The only view of single, wipe, flip and difference; the one of A otherwise.
    ImageView& main_view();
    /// Views of this mode in the order of the pictures.
    std::vector<ImageView*> views() const;
    /// Stages: between picture i and i + 1, and last that of the chosen pair.
    std::vector<ImageView*> difference_views() const;
    /// Stages: what stands under each view, numbers under differences.
    QStringList captions() const;
    /// Stages: where the name of a picture of the row can be clicked, in the board that holds the views.
    QRect stage_handle(int picture) const { return caption_rect(picture); }
    /// A worker is under way.
    bool is_computing() const;

    /// All panes as they are arranged; stages in full, also what is scrolled away.
    QImage snapshot(bool overlays, bool legend,
                    ImageView::SnapshotScale scale = ImageView::SnapshotScale::as_shown) const;

  public slots:
    /// Exchanges A and B with their displays. The owner exchanges its own record when `swapped` comes.
    void swap();
    void set_linked(bool linked);
    void fit();
    void actual_pixels();
    void zoom_in();
    void zoom_out();
    void look_at(QPointF image_px, double zoom);
    /// Flip: the next picture stays on.
    void flip_next();

  signals:
    /// Pixel under the cursor and the picture (-1: a difference; as many as there are: the reference); (-1,
    /// -1) outside.
    void cursor_moved(QPoint pixel, int picture);
    void picked_changed(QPoint pixel);
    /// Drawn, moved, resized or (empty) cleared by hand, in pictures of that size.
    void region_changed(QSize size, QRect region);
    void zoom_changed(double zoom);
    void transform_changed(const ir::widgets::ViewTransform& transform);
    /// While linked, the camera of all pictures; else of this one alone.
    void camera_moved(const ir::widgets::CameraPose& pose, int picture);
    void camera_gesture_finished(int picture);
    void tool_changed(ir::widgets::ImageView::Tool tool);
    void activated(int picture);
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
    /// What a pane shows: a picture, or the difference between it and the next one; or B of the chosen pair,
    /// and the pair's difference.
    struct Content {
        int picture = 0;
        bool difference = false;
        int slot = 0;  ///< of the worker, for a difference
    };
    static constexpr int pair_slot = 63;
    std::vector<Content> contents() const;
    bool has_rows() const { return mode_ == Mode::stages; }
    void refresh();
    void fill(ImageView& pane, const Content& content);
    void fill_difference(ImageView& pane, int slot);
    void fill_wipe(ImageView& pane);
    Display stage_display() const;

    // compare_stages.cpp
    void choose_pair(StagePair pair);
    bool has_pair() const;
    const Picture& stage(int picture) const;
    StagePair ends_of(int slot) const;
    QString stage_name(int picture) const;
    int caption_height() const;
    QString number_of(int slot) const;
    QString caption_of(const Content& content) const;
    QRect caption_rect(int pane) const;
    void paint_captions(QPainter& painter) const;
    int stage_at(QPoint point) const;
    QString tip_at(QPoint point) const;
    bool on_board_event(QEvent* event);
    bool choose_by_key(const QKeyEvent& event);
    void update_bar();
    static QString letter_of(int picture);

    void request_differences();
    void show_difference(int slot);
    void update_legends();
    void relink();
    void place();
    void paint_board();
    struct Grid {
        int columns, rows;
    };
    Grid grid(int panes) const;
    QPoint corner(int index, QSize step) const;
    QRect cell(int index, QSize board) const;
    QSize least_board() const;
    ImageView* pane(int index);
    void connect_pane(ImageView* view, int index);
    int picture_of(int pane, QPoint pixel) const;
    int shown_picture() const;
    void camera_from(int pane, const CameraPose& pose);
    bool may_hold() const;
    void hold(int picture);
    QString pane_label(int picture) const;
    QString size_refusal() const;
    QString missing_picture() const;
    QString noise_refusal() const;
    void update_regions();
    void mark(ImageView& view) const;
    bool is_right_of_wipe(int pane, QPoint pixel) const;
    int count() const { return int(pictures_.size()); }

    ImageView::Surface surface_;
    Mode mode_ = Mode::single;
    DifferenceKind kind_ = DifferenceKind::signed_;
    double wipe_ = 0.5;
    std::vector<std::shared_ptr<const Picture>> pictures_;
    std::vector<Display> displays_;
    std::vector<CameraPose> poses_;
    std::optional<Display> difference_display_;
    Display shown_difference_;
    QScrollArea* scroll_;
    QWidget* board_;
    std::vector<ImageView*> panes_;  ///< those after contents() are hidden
    ViewLink* link_;
    DifferenceWorker* worker_;
    StageBar* bar_;
    StagePair pair_;
    bool has_reference_ = false;
    std::shared_ptr<const Picture> reference_;
    bool legend_ = false, pixel_grid_ = true;
    ImageView::Tool tool_ = ImageView::Tool::inspect;
    double fly_speed_ = 1;
    QPoint picked_{-1, -1};
    QSize picked_size_;
    QPoint pointed_{-1, -1};
    std::vector<PinMark> pins_;
    QSize region_size_;
    QRect region_;
    QString noise_hint_;
    int active_pane_ = 0, pointed_pane_ = 0, flipped_ = 0, held_ = -1;
};

/// Signed and significant: a diverging map from -m … m; absolute and squared: 0 … m; relative: 0 … 1, or to m
/// where that is less; both kinds of ꟻLIP: 0 … 1. m is the largest magnitude of the finite values.
Display display_for_difference(DifferenceKind kind, const Image& difference);

}  // namespace ir::widgets
