#include "app/gui/note_links.h"

#include <QDesktopServices>
#include <algorithm>

#include "app/gui/pixel_places.h"
#include "app/gui/text_of.h"
#include "projects/text.h"

namespace ir::gui {
namespace {

constexpr double least_zoom = 8;  ///< at pins: single pixels are seen

bool is_web_page(const QUrl& link) {
    return link.scheme() == QLatin1String("https") || link.scheme() == QLatin1String("http");
}

}  // namespace

NoteLinks::NoteLinks(const widgets::NotesStrip& notes, Session& session, Workspace& workspace,
                     PixelInspector& inspector, DockLayout& docks, Finder& finder, Notices& notices)
    : session_(session),
      workspace_(workspace),
      inspector_(inspector),
      docks_(docks),
      finder_(finder),
      notices_(notices) {
    connect(&notes, &widgets::NotesStrip::link_chosen, this, &NoteLinks::follow);
}

void NoteLinks::follow(const QUrl& link) {
    if (is_web_page(link)) {
        QDesktopServices::openUrl(link);
        return;
    }
    const auto place = projects::note_link(link.toString().toStdString());
    const QString why_not = place ? go_to(*place) : tr("it names no place in this window");
    if (why_not.isEmpty()) return;
    notices_.say(tr("The link %1 leads nowhere: %2.")
                     .arg(text_of(projects::printable(link.toEncoded().toStdString())), why_not));
}

QString NoteLinks::go_to(const projects::NoteLink& link) {
    using projects::NotePlace;
    switch (link.place) {
        case NotePlace::view:
            return go_to_view(text_of(link.name));
        case NotePlace::pin:
            return go_to_pin(text_of(link.name));
        case NotePlace::parameter:
            return go_to_parameter(link.name);
        case NotePlace::buffer:
            return go_to_buffer(link.name);
        case NotePlace::experiment:
            break;
    }
    const auto why_not = go_to_experiment(link.name);
    return why_not.isEmpty() && !link.buffer.empty() ? go_to_buffer(link.buffer) : why_not;
}

QString NoteLinks::go_to_view(const QString& number) {
    auto& area = workspace_.area();
    const auto views = area.as_one_reads();
    const int place = number.toInt();
    if (place < 1 || place > int(views.size())) return tr("that view is not open");
    area.go_to(views[std::size_t(place - 1)]);
    return {};
}

/// The active view's picture moves, the camera does not.
QString NoteLinks::go_to_pin(const QString& number) {
    const auto& pins = inspector_.pins();
    const int pin = number.toInt();
    if (pin < 1 || pin > int(pins.size())) return tr("there is no such pin (P pins a pixel)");
    auto& pane = workspace_.active_pane();
    auto& view = pane.compare().active_view();
    const auto main = workspace_.views().rules().main_size(workspace_.views().active_state().a.owner);
    const auto pixel =
        pixel_of_level(main, {view.image().width, view.image().height}, pins[std::size_t(pin - 1)]);
    if (pane.content() != widgets::ViewPane::Content::picture || pixel.x() < 0)
        return tr("the active view shows no picture with that pixel");
    const auto& seen = view.transform();
    view.look_at(QPointF(pixel) + QPointF(0.5, 0.5),
                 seen.is_fitted() ? least_zoom : std::max(least_zoom, seen.zoom()));
    docks_.raise("inspector");
    return {};
}

QString NoteLinks::go_to_parameter(const std::string& key) {
    const auto* method = session_.method();
    if (!method || !find(method->parameters, key)) return tr("the method has no such parameter");
    finder_.show_parameter(key);
    return {};
}

QString NoteLinks::go_to_experiment(const std::string& id) {
    if (!session_.experiment(id)) return tr("there is no such experiment");
    finder_.go_to({widgets::ItemKind::experiment, text_of(id)});
    return {};
}

QString NoteLinks::go_to_buffer(const std::string& key) {
    auto& views = workspace_.views();
    const auto outputs = views.pictures().outputs(views.active_state().a.owner);
    if (!views.pictures().find(outputs, key)) return tr("the active view's method has no such buffer");
    views.show_output(key);
    return {};
}

}  // namespace ir::gui
