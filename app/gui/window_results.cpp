#include <QMenu>

#include "app/gui/main_window.h"

/// References and kept results in the window.
namespace ir::gui {
namespace {

/// Also while it is disabled, a tooltip says what an action would do, and why it cannot.
void set_reason(QAction& action, const QString& why_not) {
    const auto help = action.data().toString();
    action.setEnabled(why_not.isEmpty());
    action.setToolTip(why_not.isEmpty() ? help : QStringLiteral("%1.\n%2").arg(help, why_not));
}

}  // namespace

void MainWindow::make_result_actions() {
    auto* match = add_action("match", tr("&Match reference"), "match", {QKeySequence(Qt::CTRL | Qt::Key_M)},
                             [this] { references_.match(references_.shown()); });
    match->setData(tr("Render the ground truth of the shown experiment beside it: the reference method with "
                      "the same scene, camera, lights, size and transport (%1)")
                       .arg(match->shortcut().toString(QKeySequence::NativeText)));
    auto* keep = add_action("keep", tr("&Keep result"), "keep",
                            {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_K)}, [this] { results_->keep(); });
    keep->setData(tr("Keep the finished picture of the shown experiment in the project, with all that it "
                     "depends on (%1)")
                      .arg(keep->shortcut().toString(QKeySequence::NativeText)));
}

void MainWindow::connect_results() {
    references_.set_banners(banners_);
    connect(&document_->tree(), &widgets::ProjectPanel::menu_opening, this,
            [this](const widgets::ItemRef& item, QMenu* menu) {
                if (item.kind != widgets::ItemKind::experiment) return;
                const auto id = item.id.toStdString();
                const auto* shown = actions_.value(QStringLiteral("match"));
                auto* match = menu->addAction(shown->icon(), tr("Match reference"));
                match->setData(shown->data());
                set_reason(*match, references_.why_not(id));
                connect(match, &QAction::triggered, this, [this, id] { references_.match(id); });
                menu->setToolTipsVisible(true);
            });
    connect(results_, &ResultsDock::said, this, [this](const QString& text) { status_->say(text); });
    connect(results_, &ResultsDock::keep_possible_changed, this, &MainWindow::update_result_actions);
    connect(results_, &ResultsDock::failed, this, [this](const QString& error) {
        messages_->add({Severity::error, "results", error.toStdString()});
        banners_->show_banner(QStringLiteral("results"), widgets::BannerStack::Kind::error, error);
    });
}

void MainWindow::update_result_actions() {
    set_reason(*actions_.value(QStringLiteral("match")), references_.why_not(references_.shown()));
    set_reason(*actions_.value(QStringLiteral("keep")), results_->why_not_keep());
    const auto& shown = workspace_.active_state();
    const bool kept = shown.a.is_kept() || (widgets::compares(shown.mode) && shown.b.is_kept());
    const bool writable = session_.experiment() && !session_.open_project().is_read_only();
    actions_.value(QStringLiteral("comparison-add"))->setEnabled(writable && !kept);
    actions_.value(QStringLiteral("comparison-add"))
        ->setToolTip(kept ? tr("A kept result cannot take part in a comparison of the project, which is of "
                               "experiments and images")
                          : tr("Keep the view as a comparison (Ctrl+K)"));
}

}  // namespace ir::gui
