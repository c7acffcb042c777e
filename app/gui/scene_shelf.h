#pragma once

#include <QObject>
#include <map>
#include <string>
#include <vector>

#include "app/gui/renderer.h"

namespace ir::gui {

/// What is known of the scenes that experiments use: asked of the renderer once for each composition.
class SceneShelf : public QObject {
    Q_OBJECT
  public:
    explicit SceneShelf(Renderer& renderer);
    /// The scene that is worked on; changed() follows, now or when it has been loaded.
    void choose(const std::vector<scene::Part>& parts);
    void clear();
    const engine::SceneSummary* current() const;
    /// Where messages about the scene lead: a key of widgets::ItemRef.
    void set_place(const std::string& place) { place_ = place; }
    /// Its parts' sources in order.
    const std::vector<scene::Part>& parts() const { return parts_; }

  signals:
    void changed();
    void message(const ir::Message& message);

  private:
    Renderer& renderer_;
    std::vector<scene::Part> parts_;
    std::string key_, place_;
    std::map<std::string, engine::SceneSummary> scenes_;  ///< the last few, by composition
};

}  // namespace ir::gui
