#pragma once

#include <QDialog>

#include "app/engine/film.h"

class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QRadioButton;

namespace ir::gui {

/// Asks what a film shows and how long it is.
class FilmDialog : public QDialog {
    Q_OBJECT
  public:
    /// Whose picture, of which size; where the experiment begins and how long something moves in it, seconds;
    /// stops of the view.
    FilmDialog(const QString& what, double begin, double moves_until, double exposure, QWidget* parent);
    /// Without the file.
    engine::Film film() const;

  signals:
    void video_wanted();
    void pictures_wanted();

  private:
    void update();
    double begin_;
    QRadioButton *time_, *turn_;
    QDoubleSpinBox *until_, *seconds_, *exposure_;
    QLabel* count_;
    QPushButton *video_, *pictures_;
};

}  // namespace ir::gui
