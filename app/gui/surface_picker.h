#pragma once

#include <optional>

#include "app/gui/dock_layout.h"
#include "app/gui/document_dock.h"
#include "app/gui/notices.h"
#include "app/gui/pixel_inspector.h"

namespace ir::gui {

/// The surface that a pixel shows: tells of which material and object it is, and leads to where the project
/// changes them.
class SurfacePicker : public QObject {
    Q_OBJECT
  public:
    SurfacePicker(Session& session, LivePictures& live, Renderer& renderer, Workspace& workspace,
                  PixelInspector& inspector, DocumentDock& document, DockLayout& docks, Notices& notices,
                  Actions& actions);

  private:
    enum class Purpose { tell, material, object };
    struct Pixel {
        std::string experiment;
        CameraPose camera;
        QPoint at{-1, -1};
        bool operator==(const Pixel&) const = default;
    };
    std::optional<Pixel> pixel_at(QPoint pixel) const;
    void find(QPoint pixel, Purpose purpose);
    void on_surface(const engine::SurfaceResult& result);
    void on_picked(QPoint pixel);
    void on_state(const std::string& experiment);
    void act(Purpose purpose);
    void tell();  ///< of the picked pixel, where the Inspector is seen
    void pick(bool on);
    void update_actions();
    void update_form();
    QString text() const;  ///< for the Inspector
    QString object_text() const;

    Session& session_;
    LivePictures& live_;
    Renderer& renderer_;
    Workspace& workspace_;
    PixelInspector& inspector_;
    DocumentDock& document_;
    DockLayout& docks_;
    Notices& notices_;
    QAction *material_, *object_;
    QPoint picked_{-1, -1};
    bool picks_ = false;                          ///< the next click chooses for a form
    int asked_ = 0;                               ///< questions so far; the last is about pixel_
    std::optional<Pixel> pixel_;                  ///< that is asked about, or known
    std::optional<engine::SurfaceResult> found_;  ///< there; absent: not yet
    Purpose purpose_ = Purpose::tell;             ///< once it is found
};

}  // namespace ir::gui
