#pragma once

#include <QObject>

#include "app/gui/scene_shelf.h"
#include "app/gui/session.h"
#include "widgets/panels/banner.h"

namespace ir::gui {

/// Offers a light where a picture of light would stay black: the scene has none, and the experiment adds
/// none.
class LightOffer : public QObject {
    Q_OBJECT
  public:
    LightOffer(Session& session, SceneShelf& scenes, widgets::BannerStack& banners);

  private:
    bool is_dark() const;
    void update();
    /// For all experiments that see the scene without light, as one step of undo.
    void add_light();

    Session& session_;
    SceneShelf& scenes_;
    widgets::BannerStack& banners_;
};

}  // namespace ir::gui
