#pragma once

#include <optional>

#include "app/gui/actions.h"
#include "app/gui/pixel_inspector.h"
#include "app/gui/scene_shelf.h"
#include "widgets/document/item_ref.h"

namespace ir::gui {

/// Lights that are added with one step, where the cursor points and where the camera stands.
class LightController : public QObject {
    Q_OBJECT
  public:
    LightController(Session& session, LivePictures& live, Renderer& renderer, SceneShelf& scenes,
                    Workspace& workspace, PixelInspector& inspector, Actions& actions);
    /// For a scene without light.
    void add_for_view();

  signals:
    /// The new light is in the document, and shines.
    void added(const ir::widgets::ItemRef& light);
    /// Why there is none.
    void said(const QString& text);

  private:
    enum class Place { surface, camera, headlight };
    /// What is asked of the renderer.
    struct Request {
        Place place;
        std::string experiment;
        CameraPose camera;
        double aspect = 1;
    };
    void update_actions();
    void place(Place place);
    void on_surface(const engine::SurfaceResult& result);
    void add(const std::string& experiment, const projects::LightSpec& light);
    double exposure() const;

    Session& session_;
    LivePictures& live_;
    Renderer& renderer_;
    SceneShelf& scenes_;
    Workspace& workspace_;
    PixelInspector& inspector_;
    QList<QAction*> all_;
    std::optional<Request> request_;
};

}  // namespace ir::gui
