#pragma once

#include <QObject>
#include <string>

#include "app/gui/live_pictures.h"
#include "widgets/panels/banner.h"

namespace ir::gui {

/// Banners about the state of the open project: read-only, left by a crash, a scene that is missing or has
/// changed, an experiment that cannot be rendered.
class ProjectBanners : public QObject {
    Q_OBJECT
  public:
    /// `window` owns the dialogs.
    ProjectBanners(QWidget& window, Session& session, LivePictures& live, widgets::BannerStack& banners);
    /// All of them, for a project that was just opened or closed.
    void update();

  signals:
    void save_as_wanted();
    void shaders_wanted();  ///< to be seen

  private:
    void take_over();
    void update_scene();
    void update_picture();
    void update_shaders();
    void locate_scene(const std::string& scene, std::size_t part);
    void accept_scene(const std::string& scene);

    QWidget& window_;
    Session& session_;
    LivePictures& live_;
    widgets::BannerStack& banners_;
};

}  // namespace ir::gui
