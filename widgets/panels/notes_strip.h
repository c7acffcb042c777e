#pragma once

#include <QUrl>
#include <QWidget>

class QLabel;
class QTextBrowser;
class QToolButton;

namespace ir::widgets {

/// What a project says of itself, above its views, as Markdown: a few lines that scroll, or folded into one.
/// Notes may be anybody's: HTML stays text, nothing is loaded, and links are only told.
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
    void link_chosen(const QUrl& link);

  protected:
    void resizeEvent(QResizeEvent* event) override;

  private:
    void update_text();
    int height_of_beginning(int width);
    QToolButton* fold_;
    QLabel* line_;
    QTextBrowser* text_;
    QString notes_;
    bool folded_ = false;
};

}  // namespace ir::widgets
