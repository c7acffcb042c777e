#pragma once

#include <QByteArray>
#include <QFile>
#include <QString>
#include <QtEndian>
#include <glm/gtc/packing.hpp>
#include <vector>

namespace ir::gui {

/// A report's page, read as a browser reads it.
class WrittenReport {
  public:
    struct Picture {
        QString name;
        float value = -1;  ///< of the first channel of the first pixel; -1: the page does not carry it
    };
    explicit WrittenReport(const QString& path) {
        QFile file(path);
        if (file.open(QIODevice::ReadOnly)) text_ = QString::fromUtf8(file.readAll());
        for (auto at = text_.indexOf(QLatin1String("<img ")); at >= 0;
             at = text_.indexOf(QLatin1String("<img "), at + 1)) {
            const auto figure = text_.mid(at, text_.indexOf(QLatin1String("</figure>"), at) - at);
            const auto pixels =
                between(figure, " width=\"", "\"").toInt() * between(figure, " height=\"", "\"").toInt();
            pictures_.push_back({between(figure, "<strong class=\"name\">", "<"),
                                 value_of(between(figure, "data:application/zlib;base64,", "\""), pixels)});
        }
    }
    const QString& text() const { return text_; }
    const std::vector<Picture>& pictures() const { return pictures_; }

  private:
    static QString between(const QString& text, const char* before, const char* after) {
        const auto start = text.indexOf(QLatin1String(before));
        if (start < 0) return {};
        const auto from = start + qsizetype(qstrlen(before));
        return text.mid(from, text.indexOf(QLatin1String(after), from) - from);
    }
    /// Half floats: low bytes, then high bytes.
    static float value_of(const QString& base64, int pixels) {
        QByteArray sized(4, 0);
        qToBigEndian(quint32(2 * pixels), sized.data());
        const auto bytes = qUncompress(sized + QByteArray::fromBase64(base64.toLatin1()));
        if (pixels == 0 || bytes.size() < 2 * pixels) return -1;
        return glm::unpackHalf1x16(glm::uint16(quint8(bytes[0]) | quint8(bytes[pixels]) << 8));
    }

    QString text_;
    std::vector<Picture> pictures_;
};

}  // namespace ir::gui
