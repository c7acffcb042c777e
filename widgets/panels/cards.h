#pragma once

#include <QAbstractButton>
#include <QImage>
#include <QLayout>
#include <vector>

namespace ir::widgets {

/// A project or sample as a button with a picture. Enter clicks it.
class Card : public QAbstractButton {
    Q_OBJECT
  public:
    struct Content {
        QString name, note;
        QString detail = {};  ///< of projects where they are, of samples how long they take
        QImage picture = {};
    };
    explicit Card(const Content& content, QWidget* parent);

  protected:
    const Content& content() const { return content_; }
    /// The ground, and a frame where it has the focus.
    void paint_ground(QPainter& painter) const;
    void paint_picture(QPainter& painter, const QRect& box) const;
    void set_name_pen(QPainter& painter) const;
    void set_note_pen(QPainter& painter) const;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;

  private:
    Content content_;
};

/// A project as a wide button: thumbnail, name, two lines about it. A note without detail may take three
/// lines; the detail is elided in the middle.
class ProjectCard : public Card {
    Q_OBJECT
  public:
    explicit ProjectCard(const Content& content, QWidget* parent = nullptr);
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return {180, sizeHint().height()}; }

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    int note_lines() const;
};

/// A sample as a button: its picture, and below that name, what it shows, and how long it takes.
class SampleCard : public Card {
    Q_OBJECT
  public:
    static constexpr int usual_width = 216;  ///< logical pixels

    explicit SampleCard(const Content& content, QWidget* parent = nullptr);
    QSize sizeHint() const override { return {usual_width, heightForWidth(usual_width)}; }
    QSize minimumSizeHint() const override { return {160, heightForWidth(160)}; }
    int heightForWidth(int width) const override;

  protected:
    void paintEvent(QPaintEvent* event) override;
};

/// Cards of equal size in rows, as many as fit beside each other; they share the width. Hidden ones take no
/// room.
class CardFlow : public QLayout {
  public:
    explicit CardFlow(int card_width, QWidget* parent = nullptr);
    ~CardFlow() override;
    void addItem(QLayoutItem* item) override { items_.push_back(item); }
    int count() const override { return int(items_.size()); }
    QLayoutItem* itemAt(int index) const override;
    QLayoutItem* takeAt(int index) override;
    QSize sizeHint() const override { return minimumSize(); }
    QSize minimumSize() const override;
    bool hasHeightForWidth() const override { return true; }
    int heightForWidth(int width) const override { return place({0, 0, width, 0}, false); }
    void setGeometry(const QRect& rect) override;
    Qt::Orientations expandingDirections() const override { return Qt::Horizontal; }

  private:
    /// Returns the height that the cards take.
    int place(const QRect& rect, bool apply) const;
    std::vector<QLayoutItem*> items_;
    int card_width_;
};

}  // namespace ir::widgets
