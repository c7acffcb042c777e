#pragma once

#include <QRect>
#include <QWidget>
#include <array>

class QSpinBox;
class QToolButton;

namespace ir::widgets {

/// The exact numbers of the rectangle, with a button for its tool and one that clears it. Without a rectangle
/// the whole picture stands there; typing makes one.
class RectangleFields : public QWidget {
    Q_OBJECT
  public:
    explicit RectangleFields(QWidget* parent = nullptr);
    /// Emits nothing. An empty size: there is no picture.
    void show(QSize picture, const QRect& rectangle, bool drawing);

  signals:
    void chosen(QRect rectangle);  ///< empty: cleared
    void drawing_toggled(bool on);

  private:
    void take();
    void show_numbers();
    std::array<QSpinBox*, 4> fields_{};  ///< x, y, width, height
    QToolButton *draw_ = nullptr, *clear_ = nullptr;
    QSize picture_;
    QRect rectangle_;
};

}  // namespace ir::widgets
