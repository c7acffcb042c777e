#pragma once

#include <QTimer>
#include <QWidget>

#include "app/gui/live_pictures.h"

class QLabel;
class QProgressBar;
class QToolButton;

namespace ir::gui {

/// What is being rendered, how far it is, how long it takes, and the button that stops it.
class StatusLine : public QWidget {
    Q_OBJECT
  public:
    StatusLine(Session& session, LivePictures& live, QWidget* parent = nullptr);
    /// For a moment, instead of the state: "Saved …".
    void say(const QString& text);
    void forget();  ///< what is being said

  signals:
    void cancel_wanted();

  private:
    void update_text();
    void update_soon();
    QString text_of_rendering(const std::vector<std::string>& ids) const;
    QString text_of_state() const;
    Session& session_;
    LivePictures& live_;
    QLabel* state_;
    QProgressBar* progress_;
    QToolButton* cancel_;
    QTimer said_, later_;
    QString saying_;
};

}  // namespace ir::gui
