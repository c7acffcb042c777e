#pragma once

#include <QObject>
#include <set>

#include "app/gui/light_controller.h"
#include "widgets/panels/banner.h"

namespace ir::gui {

/// What shines in an experiment: of the scene and of the set that it chose, null for the scene's own.
std::set<LightKind> kinds_of_light(const std::vector<LightSource>& scene, const projects::LightSet* set);

/// Why the method's picture of light has none, for people; empty: it has some, or shows something else.
QString why_dark(const MethodDescription& method, const Settings& settings, const std::set<LightKind>& kinds);

/// Offers a light where a picture of light would stay black: nothing shines, or nothing whose light the
/// method takes.
class LightOffer : public QObject {
    Q_OBJECT
  public:
    LightOffer(Session& session, SceneShelf& scenes, LightController& lights, widgets::BannerStack& banners);

  private:
    QString text() const;
    void update();

    Session& session_;
    SceneShelf& scenes_;
    LightController& lights_;
    widgets::BannerStack& banners_;
};

}  // namespace ir::gui
