#pragma once

#include <QString>

#include "app/gui/session.h"

namespace ir::gui {

/// What is to be said of a setting that was loaded, or why it was not; both are empty where the session has
/// told why itself.
struct Loading {
    QString said, failed;
};

/// Puts coordinates of a point or variation into an experiment, as one undo step. `setting` names them, and
/// `from` says where they come from.
Loading load_setting(Session& session, std::string experiment, const projects::Json& coordinates,
                     const QString& setting, const char* from);

}  // namespace ir::gui
