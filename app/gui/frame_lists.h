#pragma once

#include <QImage>
#include <QObject>
#include <map>
#include <string>

#include "app/gui/workspace.h"
#include "widgets/panels/rows_panel.h"

class QAction;

namespace ir::gui {

class Preferences;

/// What the newest frame of the chosen experiment consists of: its buffers, and times and counters of its
/// passes. A click on a buffer shows it, its menu does more, and it can be dragged into a view.
class FrameLists : public QObject {
    Q_OBJECT
  public:
    FrameLists(Session& session, const Preferences& preferences, LivePictures& live, Workspace& workspace);
    widgets::RowsPanel& buffers() { return *buffers_; }
    QWidget& timings() { return *timings_and_counters_; }
    /// More of them in the menu of buffers.
    void add_actions(const QList<QAction*>& actions);
    /// The menu of a buffer, wherever it is seen.
    void show_menu(const std::string& key, QPoint global_position);
    void show_in_another_view(const std::string& key);
    /// Small pictures of the frame's images, by their keys, as far as somebody wants them.
    const std::map<std::string, QImage>& thumbnails() const { return thumbnails_; }

  signals:
    void changed();
    /// Of the buffer that the active view shows.
    void export_wanted();

  private:
    void add_buffer_actions();
    void compare_with(const std::string& key);
    void clear();
    void update();

    Session& session_;
    LivePictures& live_;
    Workspace& workspace_;
    ViewModel& views_;
    widgets::RowsPanel *buffers_, *timings_, *counters_;
    QWidget* timings_and_counters_;
    std::map<std::string, QImage> thumbnails_;
};

}  // namespace ir::gui
