#include "app/gui/write_picture.h"

#include <QBuffer>
#include <QFileInfo>

#include "renderers/core/error.h"
#include "renderers/core/write_file.h"

namespace ir::gui {

void write_picture(const QString& file, const QImage& picture) {
    const auto suffix = QFileInfo(file).suffix().toLatin1();
    QByteArray encoded;
    QBuffer buffer(&encoded);
    buffer.open(QIODevice::WriteOnly);
    if (!picture.save(&buffer, suffix.isEmpty() ? "PNG" : suffix.constData()))
        throw Error(file.toStdString() + ": pictures cannot be written so; give a name that ends with .png");
    write_file(file.toStdString(), {encoded.constData(), std::size_t(encoded.size())});
}

}  // namespace ir::gui
