#include "app/gui/result_controller.h"

#include <QAction>
#include <QMenu>

namespace ir::gui {

using K = QKeySequence;

ResultController::ResultController(Session& session, LivePictures& live, Playback& playback, ViewModel& views,
                                   References& references, ResultsDock& results, DocumentDock& document,
                                   Actions& actions)
    : session_(session), views_(views), references_(references), results_(results), document_(document) {
    add_actions(actions);
    connect(&document_.tree(), &widgets::ProjectPanel::menu_opening, this, &ResultController::fill_menu);
    connect(&results_, &ResultsDock::keep_possible_changed, this, &ResultController::update);
    connect(&playback, &Playback::changed, this, &ResultController::update);
    connect(&live, &LivePictures::state_changed, this, &ResultController::update);
    follow(session_, this, &ResultController::update);
    update();
}

void ResultController::add_actions(Actions& actions) {
    compare_ = actions.add("comparison-add", tr("Keep the vie&w as a comparison"), nullptr,
                           {K(Qt::CTRL | Qt::Key_K)}, [this] { document_.add_comparison(); });
    match_ = actions.add("match", tr("&Match reference"), "match", {K(Qt::CTRL | Qt::Key_M)},
                         [this] { references_.match(references_.shown()); });
    match_->setData(tr("Render the ground truth of the shown experiment beside it: the reference method with "
                       "the same scene, camera, lights, size and transport (%1)")
                        .arg(match_->shortcut().toString(K::NativeText)));
    keep_ = actions.add("keep", tr("&Keep result"), "keep", {K(Qt::CTRL | Qt::SHIFT | Qt::Key_K)},
                        [this] { results_.keep(); });
    keep_->setData(tr("Keep the finished picture of the shown experiment in the project, with all that it "
                      "depends on (%1)")
                       .arg(keep_->shortcut().toString(K::NativeText)));
}

void ResultController::fill_menu(const widgets::ItemRef& item, QMenu* menu) {
    if (item.kind != widgets::ItemKind::experiment) return;
    const auto id = item.id.toStdString();
    auto* match = menu->addAction(match_->icon(), tr("Match reference"));
    match->setData(match_->data());
    set_reason(*match, references_.why_not(id));
    connect(match, &QAction::triggered, this, [this, id] { references_.match(id); });
    menu->setToolTipsVisible(true);
}

void ResultController::update() {
    set_reason(*match_, references_.why_not(references_.shown()));
    set_reason(*keep_, results_.why_not_keep());
    const auto& shown = views_.active_state();
    const bool kept = shown.a.is_kept() || (widgets::compares(shown.mode) && shown.b.is_kept());
    const bool writable = session_.experiment() && !session_.open_project().is_read_only();
    compare_->setEnabled(writable && !kept);
    compare_->setToolTip(kept ? tr("A kept result cannot take part in a comparison of the project, which is "
                                   "of experiments and images")
                              : tr("Keep the view as a comparison (Ctrl+K)"));
}

}  // namespace ir::gui
