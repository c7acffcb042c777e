#pragma once

#include <QTreeView>

namespace ir::widgets {

/// In the middle of a view without rows, at the end of its paintEvent().
void paint_empty_text(QAbstractItemView& view, const QString& text);

/// Says why it is empty.
class EmptyTreeView : public QTreeView {
    Q_OBJECT
  public:
    explicit EmptyTreeView(const QString& empty_text, QWidget* parent = nullptr);
    const QString& empty_text() const { return empty_text_; }
    void set_empty_text(const QString& text);

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    bool is_any_shown() const;

    QString empty_text_;
};

}  // namespace ir::widgets
