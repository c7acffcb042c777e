#pragma once

#include <QAbstractButton>
#include <QImage>

namespace ir::widgets {

/// A project as a wide button: thumbnail, name, two lines about it.
class ProjectCard : public QAbstractButton {
    Q_OBJECT
  public:
    struct Content {
        QString name, note,
            detail;  ///< a note without detail may take three lines; the detail is elided in the middle
        QImage thumbnail;
    };
    explicit ProjectCard(const Content& content, QWidget* parent = nullptr);
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return {180, sizeHint().height()}; }

  protected:
    void paintEvent(QPaintEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;

  private:
    int note_lines() const;
    Content content_;
};

}  // namespace ir::widgets
