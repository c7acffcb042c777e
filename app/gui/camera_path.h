#pragma once

#include <QObject>
#include <map>
#include <string>

#include "app/gui/actions.h"
#include "app/gui/notices.h"
#include "app/gui/playback.h"
#include "app/gui/workspace.h"

namespace ir::gui {

/// Makes paths of cameras out of views: each key is where the view stands. A path is a motion of a camera in
/// the document. Who looks around leaves it with a camera of its own and comes back with the next key.
class CameraPath : public QObject {
    Q_OBJECT
  public:
    CameraPath(QObject& parent, Session& session, LivePictures& live, Playback& playback,
               Workspace& workspace, Notices& notices, Actions& actions);

    /// The motion that the camera of an experiment has, or had before somebody looked around; null: none.
    const projects::Motion* path(const std::string& experiment) const;

  signals:
    void changed();

  private:
    void update();
    void add_key();
    void set_key();
    void remove_key();
    void go(int keys);
    void write_key(double time);
    /// Goes to the time of a key, and says which it is.
    void show_key(const projects::Motion& motion, std::size_t place);
    void return_to_path();
    /// The key of a path at the shown time; none: its number of keys.
    std::size_t key_here(const projects::Motion& motion) const;

    Session& session_;
    LivePictures& live_;
    Playback& playback_;
    Workspace& workspace_;
    Notices& notices_;
    Actions& actions_;
    std::map<std::string, std::string> last_;  ///< by experiment: the motion that its camera had last
};

}  // namespace ir::gui
