#include "widgets/style/rich_text.h"

#include <QBuffer>

namespace ir::widgets {

QString picture_text(const QImage& picture) {
    if (picture.isNull()) return {};
    QByteArray file;
    QBuffer buffer(&file);
    picture.save(&buffer, "PNG");
    return QStringLiteral("<img src='data:image/png;base64,%1'><br>").arg(QLatin1String(file.toBase64()));
}

}  // namespace ir::widgets
