#pragma once

#include <optional>
#include <string>
#include <vector>

#include <QStringList>

#include "app/gui/kept_pictures.h"
#include "app/gui/live_pictures.h"
#include "widgets/views/view_state.h"

namespace ir::gui {

/// Whether two pictures are of the same computation, so that their difference is one of methods.
class PictureMismatch {
  public:
    PictureMismatch(const Session& session, const LivePictures& live, const KeptPictures& kept)
        : session_(session), live_(live), kept_(kept) {}

    /// In what the computations of two pictures differ, in one line; empty: in nothing, or nobody knows.
    QString of(const widgets::ViewSource& a, const widgets::ViewSource& b) const;

  private:
    /// Of two experiments: in what settings, as far as both have them; absent where one is not known.
    std::optional<QStringList> settings(const std::string& a, const std::string& b) const;
    QStringList sources(const projects::Experiment& a, const projects::Experiment& b,
                        const std::vector<LightPart>& parts) const;
    /// "time 0 s / 0.5 s" where something moves and two owners show it at different moments; else empty.
    QString moments(const std::string& a, const std::string& b) const;

    const Session& session_;
    const LivePictures& live_;
    const KeptPictures& kept_;
};

}  // namespace ir::gui
