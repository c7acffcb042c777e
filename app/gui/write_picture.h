#pragma once

#include <QImage>
#include <QString>

namespace ir::gui {

/// In the format that the name ends with; PNG where it ends with none. Throws Error, also where not all of it
/// could be stored: what stood there before stays.
void write_picture(const QString& file, const QImage& picture);

}  // namespace ir::gui
