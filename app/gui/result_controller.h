#pragma once

#include <QObject>

#include "app/gui/actions.h"
#include "app/gui/document_dock.h"
#include "app/gui/playback.h"
#include "app/gui/references.h"
#include "app/gui/results_dock.h"

namespace ir::gui {

/// What becomes of the picture that is shown: it is kept, compared, or gets its ground truth.
class ResultController : public QObject {
    Q_OBJECT
  public:
    ResultController(Session& session, LivePictures& live, Playback& playback, ViewModel& views,
                     References& references, ResultsDock& results, DocumentDock& document, Actions& actions);

  private:
    void add_actions(Actions& actions);
    void fill_menu(const widgets::ItemRef& item, QMenu* menu);
    void update();

    Session& session_;
    ViewModel& views_;
    References& references_;
    ResultsDock& results_;
    DocumentDock& document_;
    QAction *compare_ = nullptr, *match_ = nullptr, *keep_ = nullptr;
};

}  // namespace ir::gui
