#pragma once

#include <QLayout>
#include <vector>

namespace ir::widgets {

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
