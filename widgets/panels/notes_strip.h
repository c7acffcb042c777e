#pragma once

#include <QWidget>

class QLabel;
class QScrollArea;
class QToolButton;

namespace ir::widgets {

/// What a project says of itself, above its views: a few lines that scroll, or folded into one.
class NotesStrip : public QWidget {
    Q_OBJECT
  public:
    explicit NotesStrip(QWidget* parent = nullptr);
    /// Without notes it takes no room.
    void set_notes(const QString& notes);
    void set_folded(bool folded);
    bool is_folded() const { return folded_; }

  signals:
    void folded_changed(bool folded);

  protected:
    void resizeEvent(QResizeEvent* event) override;

  private:
    void update_text();
    QToolButton* fold_;
    QLabel *line_, *text_;
    QScrollArea* scroll_;
    QString notes_;
    bool folded_ = false;
};

}  // namespace ir::widgets
