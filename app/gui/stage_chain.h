#pragma once

#include <QString>
#include <string>
#include <vector>

#include "app/gui/session.h"
#include "widgets/views/view_state.h"

namespace ir::gui {

/// A picture of the chain that an experiment's method names (MethodDescription::stages).
struct ChainStage {
    widgets::ViewSource source;
    QString label;
};

/// The stages that there are under the experiment's settings, in order; empty where its method names none,
/// and for what is no experiment.
std::vector<ChainStage> stages_of(const Session& session, const std::string& owner);

/// Whether the method names any, under whatever settings.
bool has_stages(const Session& session, const std::string& owner);

/// The main result of the experiment's reference; an empty owner where it has none.
widgets::ViewSource reference_of(const Session& session, const std::string& owner);

}  // namespace ir::gui
