#pragma once

#include <QListView>
#include <vector>

#include "widgets/sweeps/sheet_pictures.h"
#include "widgets/sweeps/sweep_model.h"

namespace ir::widgets {

/// The variations of a sweep as pictures in a grid, over a model that sorts a SweepModel. All show the same
/// part of their picture: Ctrl+wheel zooms, a drag moves. Only what is seen is read.
class ContactSheet : public QListView {
    Q_OBJECT
  public:
    enum class Shows { pictures, differences, both };
    static constexpr int min_width = 90, usual_width = 180,
                         max_width = 640;  ///< of a picture, logical pixels

    ContactSheet(const SweepModel& model, QWidget* parent = nullptr);
    SheetPictures& pictures() { return pictures_; }
    void set_shows(Shows shows);
    void set_picture_width(int width);
    /// The column whose number stands below each picture; 0: none.
    void set_told_column(int column);

    /// The part of each picture that is shown, of 0 … 1 in both directions.
    QRectF part() const { return part_; }
    void zoom(double factor, QPointF about = {0.5, 0.5});
    void show_all();
    /// Rows of the sorting model that are seen at least in part: first and one behind the last.
    std::pair<int, int> seen_rows() const;
    /// Where a row's pictures are, in the viewport; the second is null unless both are shown.
    std::pair<QRect, QRect> boxes(const QModelIndex& index) const;

    void paint_cell(QPainter& painter, const QStyleOptionViewItem& option, const QModelIndex& index) const;
    /// Of two axes and more, values of the last stand below each other while rows have the sweep's order and
    /// all of them have room in a row.
    void doItemsLayout() override;

  signals:
    /// Clicked, or chosen with Enter.
    void variation_chosen(const QString& id);

  protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override { mousePressEvent(event); }
    void keyPressEvent(QKeyEvent* event) override;

  private:
    const SweepLine& line(const QModelIndex& index) const;
    std::vector<SheetRequest> requests(const SweepLine& line) const;
    void fit_grid();
    int columns(int room) const;
    void ask_for_seen();
    void set_part(QRectF part);
    void select(const QModelIndex& index, Qt::KeyboardModifiers modifiers);
    /// Of the picture that a place lies on, else of the middle.
    QPointF place_in_picture(QPoint at) const;

    const SweepModel& model_;
    SheetPictures pictures_;
    Shows shows_ = Shows::pictures;
    int width_ = usual_width, told_ = 0;
    double aspect_ = 0.75;  ///< height over width of the pictures
    QRectF part_{0, 0, 1, 1};
    QPoint pressed_, dragged_;
    bool is_pressed_ = false, is_dragging_ = false;
};

}  // namespace ir::widgets
