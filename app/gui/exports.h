#pragma once

#include <QImage>
#include <QString>
#include <string>

#include "app/gui/workspace.h"
#include "renderers/image/image.h"

namespace ir::gui {

/// Files of what the active view shows. All throw Error with one line that names the file.
class Exports {
  public:
    Exports(Session& session, LivePictures& live, Renderer& renderer, Workspace& workspace)
        : session_(session), live_(live), renderer_(renderer), workspace_(workspace) {}

    /// As seen, with labels, legend and marks.
    QImage view() const;
    void save_view(const QString& file) const;
    /// The buffer's values as they are; for differences those, for pairs A.
    ImageLayer buffer() const;
    void save_buffer(const QString& file) const;
    /// Values of a picture (x, y, channels) or of a buffer's elements, as comma-separated lines.
    void save_values(const QString& file) const;
    /// All buffers that exist in one multi-layer EXR; written by the renderer, which answers with exported().
    void save_all_buffers(const QString& file) const;
    /// What the active view shows, in a few words.
    QString title() const;
    QString owner_title() const;  ///< of the experiment or file that it is of

  private:
    /// Throws Error where the active view shows a draft.
    void check_full() const;
    std::shared_ptr<const widgets::Picture> picture() const;
    Session& session_;
    LivePictures& live_;
    Renderer& renderer_;
    Workspace& workspace_;
};

/// Lines "x,y,R,G,B" of a picture, with the digits that read back as the same float; pixels without a value
/// are empty. Atlases name level and slice first.
void write_csv(std::ostream& out, const widgets::Picture& picture);

/// In the format that the name ends with; PNG where it ends with none. Throws Error, also where not all of it
/// could be stored: what stood there before stays.
void write_picture(const QString& file, const QImage& picture);
/// The bytes of such a file, in the format that the name's ending says. Throws Error.
QByteArray encoded(const QImage& picture, const QString& file);

}  // namespace ir::gui
