#pragma once

#include <QObject>

#include "app/gui/light_controller.h"
#include "widgets/panels/banner.h"

namespace ir::gui {

/// Offers a light where a picture of light would stay black: the scene has none, and the experiment adds
/// none.
class LightOffer : public QObject {
    Q_OBJECT
  public:
    LightOffer(Session& session, SceneShelf& scenes, LightController& lights, widgets::BannerStack& banners);

  private:
    bool is_dark() const;
    void update();

    Session& session_;
    SceneShelf& scenes_;
    LightController& lights_;
    widgets::BannerStack& banners_;
};

}  // namespace ir::gui
