#pragma once

#include <QObject>
#include <map>
#include <optional>
#include <string>

#include "app/gui/camera_path.h"
#include "app/gui/pixel_inspector.h"
#include "widgets/space/space_marks.h"

namespace ir::gui {

/// Pins and camera paths in space: finds the surfaces that pinned pixels show, marks them and the paths in
/// 3D views, and flies to a pin.
class SpaceMarker : public QObject {
    Q_OBJECT
  public:
    SpaceMarker(QObject& parent, Session& session, LivePictures& live, Renderer& renderer,
                Workspace& workspace, PixelInspector& inspector, const CameraPath& path, Playback& playback,
                Notices& notices, Actions& actions);

    /// Of an experiment as it is shown; absent: not known yet, or the pixel shows no surface.
    std::optional<glm::dvec3> place(const std::string& experiment, QPoint pin) const;
    /// To what a pin shows (by its number from 0 on): in a 3D view its own camera, else the experiment's.
    void fly_to(int pin);

  private:
    struct Places {
        std::string picture;  ///< that they are of, with its camera
        int generation = 0;   ///< another one for each picture
        std::map<std::pair<int, int>, std::optional<glm::dvec3>> of_pin;  ///< absent: asked for
    };
    void update();
    void find_places(const std::string& experiment);
    void on_surface(const engine::SurfaceResult& result);
    void fly_to_next();
    void land(int pin, const glm::dvec3& place);
    widgets::SpaceMarks marks_of(const std::string& experiment) const;
    void add_path(widgets::SpaceMarks& marks, const std::string& experiment) const;
    bool shows_space(int view) const;
    bool stands_in_scene(int view) const;
    double aspect_of(const std::string& experiment) const;

    Session& session_;
    LivePictures& live_;
    Renderer& renderer_;
    Workspace& workspace_;
    PixelInspector& inspector_;
    const CameraPath& path_;
    Playback& playback_;
    Notices& notices_;
    std::map<std::string, Places> places_;
    int generations_ = 0;
    int flown_to_ = -1;      ///< pin
    std::string will_land_;  ///< asker for the pin that is flown to once its place is known; empty: none
};

}  // namespace ir::gui
