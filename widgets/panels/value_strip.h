#pragma once

#include <QWidget>

#include "widgets/image/display.h"
#include "widgets/image/picture.h"

class QLabel;

namespace ir::widgets {

/// One line below the picture: the pixel under the cursor with all its values, or else what the whole picture
/// is like.
class ValueStrip : public QWidget {
    Q_OBJECT
  public:
    explicit ValueStrip(QWidget* parent = nullptr);
    /// Numbers are of the pixels that `valid` includes; null: of all.
    void set_picture(const Image& image, Semantic semantic, const QString& name, const QString& unit,
                     const Atlas& atlas = {}, const Image* valid = nullptr);
    /// "x 12  y 40   R 0.25  G 0.5  B 1 W/(m² sr)"; levels and slices of an atlas by their own pixels. The
    /// summary for a pixel that the picture does not have. `who`, "B", stands before it; may be empty.
    void show_pixel(const Picture& picture, QPoint pixel, const QString& who = {});
    /// Anything else about the pixel under the cursor.
    void show_text(const QString& text) { say(text, false); }
    void set_zoom(double zoom);
    /// The whole line; what is shown lacks mean, max and min where they do not fit.
    QString text() const { return full_; }

  protected:
    void resizeEvent(QResizeEvent*) override;

  private:
    /// With so many of min, max and mean.
    QString summary(int statistics = 3, bool named = true) const;
    void say(const QString& full, bool is_summary);
    void update_line();
    QLabel *values_, *zoom_;
    Statistics statistics_;
    Semantic semantic_ = Semantic::generic;
    QString name_, unit_, full_;
    bool is_summary_ = true;
    QSize size_;
    int channels_ = 0;
};

}  // namespace ir::widgets
