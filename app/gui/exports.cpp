#include "app/gui/exports.h"

#include <QBuffer>
#include <QFileInfo>
#include <cmath>

#include "renderers/core/error.h"
#include "renderers/core/value.h"
#include "renderers/core/write_file.h"
#include "renderers/image/channels.h"
#include "renderers/image/exr.h"

namespace ir::gui {
namespace {

void write_number(std::ostream& out, float value) {
    out << shortest_text(value);
}

}  // namespace

void write_csv(std::ostream& out, const widgets::Picture& picture) {
    const auto& image = *picture.image;
    const bool tiled = !picture.atlas.tiles.empty();
    out << (tiled ? "level,slice,x,y" : "x,y");
    for (int c = 0; c < image.channels; ++c)
        out << ',' << widgets::channel_name(picture.semantic, image.channels, c).toStdString();
    out << '\n';
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const auto place = widgets::locate(picture, {x, y});
            if (place.pixel.x() < 0) continue;  // the gap between tiles
            if (tiled) out << place.level << ',' << place.layer << ',';
            out << place.pixel.x() << ',' << place.pixel.y();
            for (int c = 0; c < image.channels; ++c) {
                out << ',';
                write_number(out, image.at(x, y, c));
            }
            out << '\n';
        }
}

void Exports::check_full() const {
    auto& pane = workspace_.active_pane();
    if (pane.content() != widgets::ViewPane::Content::picture) return;
    for (const auto* view : pane.compare().views())
        for (const auto& each : view->state().pictures)
            if (each.picture && !each.picture->draft.isEmpty())
                throw Error("the full picture is still being rendered; export it when it is there");
}

std::shared_ptr<const widgets::Picture> Exports::picture() const {
    check_full();
    const auto shown = workspace_.display_picture();
    if (workspace_.active_pane().content() != widgets::ViewPane::Content::picture || !shown ||
        !shown->has_image())
        throw Error("the active view shows no image; choose an image output (or, for values, a table)");
    return shown;
}

QString Exports::title() const {
    return owner_title() + QLatin1Char(' ') + QString::fromStdString(workspace_.views().shown_key());
}

QString Exports::owner_title() const {
    const auto& state = workspace_.views().active_state();
    return QString::fromStdString(workspace_.views().pictures().owner_name(state.a.owner));
}

QImage Exports::view() const {
    check_full();
    QImage image = workspace_.active_pane().snapshot(true);
    if (image.isNull()) throw Error("the view shows nothing to save");
    return image;
}

void Exports::save_view(const QString& file) const {
    write_picture(file, view());
}

ImageLayer Exports::buffer() const {
    const auto shown = picture();
    return {"", channel_names(shown->semantic, shown->image->channels), *shown->image};
}

void Exports::save_buffer(const QString& file) const {
    write_exr(file.toStdString(), {buffer()}, {{"interreflect.shown", picture()->label.toStdString()}});
}

void Exports::save_values(const QString& file) const {
    auto& pane = workspace_.active_pane();
    if (pane.content() == widgets::ViewPane::Content::table) return pane.table().save_csv(file);
    const auto shown = picture();
    write_file(file.toStdString(), [&](std::ostream& out) { write_csv(out, *shown); });
}

void Exports::save_all_buffers(const QString& file) const {
    const auto& state = workspace_.views().active_state();
    const auto& owner = state.a.is_file() ? state.b.owner : state.a.owner;
    if (!session_.experiment(owner)) throw Error("the active view shows no experiment; choose one");
    if (live_.past().is_elsewhere())
        throw Error("a past frame has only the buffers that views showed; go back to now (Alt+N)");
    if (!live_.result(owner)) throw Error("nothing has been rendered yet");
    renderer_.export_layers({owner, file.toStdString(), {"*"}});
}

QByteArray encoded(const QImage& picture, const QString& file) {
    const auto suffix = QFileInfo(file).suffix().toLatin1();
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    if (!picture.save(&buffer, suffix.isEmpty() ? "PNG" : suffix.constData()))
        throw Error(file.toStdString() + ": pictures cannot be written so; give a name that ends with .png");
    return bytes;
}

void write_picture(const QString& file, const QImage& picture) {
    const auto bytes = encoded(picture, file);
    write_file(file.toStdString(), {bytes.constData(), std::size_t(bytes.size())});
}

}  // namespace ir::gui
