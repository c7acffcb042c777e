#include "app/gui/load_setting.h"

#include <QObject>

#include "app/gui/text_of.h"
#include "projects/coordinate.h"

namespace ir::gui {

Loading load_setting(Session& session, std::string experiment, const projects::Json& coordinates,
                     const QString& setting, const char* from) {
    const auto& open = session.open_project();
    if (open.is_read_only())
        return {{},
                QObject::tr("%1 is not loaded: the project is open read-only: %2")
                    .arg(setting, text_of(open.read_only_reason()))};
    bool is_refused = true;  // until there is an edit, which may change nothing
    const bool changed = session.edit([&](const projects::Project& project) {
        auto edit = projects::edits::set_coordinates(project, session.registry(), experiment, coordinates,
                                                     "Load " + setting.toStdString() + " from " + from);
        is_refused = false;
        return edit;
    });
    session.end_gesture();
    if (is_refused) return {};
    const auto* found = session.experiment(experiment);
    const auto name = text_of(found ? found->name : experiment);
    return {(changed ? QObject::tr("Loaded %1 into %2") : QObject::tr("%2 has %1")).arg(setting, name), {}};
}

}  // namespace ir::gui
