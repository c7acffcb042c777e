#pragma once

#include <QObject>
#include <string>

#include "app/gui/view_model.h"
#include "projects/match.h"
#include "widgets/panels/banner.h"

namespace ir::gui {

/// The ground truth that experiments are judged by: set up from their own transport, shown beside them, and a
/// banner where the two have gone apart.
class References : public QObject {
    Q_OBJECT
  public:
    References(Session& session, LivePictures& live, ViewModel& views, widgets::BannerStack& banners);

    /// The experiment that the active view shows, else the one that is worked on; empty: none.
    std::string shown() const;
    /// Why an experiment cannot get a reference; empty: it can.
    QString why_not(const std::string& experiment) const;
    /// Takes or adds the reference of an experiment, and shows it as B of the active view. One step of undo.
    void match(const std::string& experiment);

  private:
    void update_banner();

    /// As far as a picture has told.
    projects::SceneFacts scene_facts() const;

    Session& session_;
    LivePictures& live_;
    ViewModel& views_;
    widgets::BannerStack& banners_;
    QString shown_text_;
};

}  // namespace ir::gui
