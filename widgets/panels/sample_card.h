#pragma once

#include <QAbstractButton>
#include <QImage>

namespace ir::widgets {

/// A sample as a button: its picture, and below that name, what it shows, and how long it takes.
class SampleCard : public QAbstractButton {
    Q_OBJECT
  public:
    struct Content {
        QString name, note, time;
        QImage picture;
    };
    static constexpr int usual_width = 216;  ///< logical pixels

    explicit SampleCard(const Content& content, QWidget* parent = nullptr);
    QSize sizeHint() const override { return {usual_width, heightForWidth(usual_width)}; }
    QSize minimumSizeHint() const override { return {160, heightForWidth(160)}; }
    int heightForWidth(int width) const override;

  protected:
    void paintEvent(QPaintEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;

  private:
    Content content_;
};

/// Draws at most `most` lines from the top of the box, the last one elided. Returns how many.
int draw_lines(QPainter& painter, const QRect& box, const QString& text, int most);
/// Fills the box with the middle of a picture, or without one with a sign for it.
void draw_project_picture(QPainter& painter, const QRect& box, const QImage& picture, bool enabled);

}  // namespace ir::widgets
