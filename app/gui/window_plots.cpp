#include <QDockWidget>

#include "app/gui/main_window.h"

/// Plots of the error, and benchmarks, in the window.
namespace ir::gui {

void MainWindow::connect_plots() {
    connect(&document_->tree(), &widgets::ProjectPanel::item_activated, this,
            [this](const widgets::ItemRef& item) {
                if (item.kind == widgets::ItemKind::plot) show_plot(item.id.toStdString());
            });
    connect(plots_, &PlotsDock::said, this, [this](const QString& text) { status_->say(text); });
    connect(plots_, &PlotsDock::failed, this, [this](const QString& error) {
        messages_->add({Severity::error, "plots", error.toStdString()});
        banners_->show_banner(QStringLiteral("plots"), widgets::BannerStack::Kind::error, error);
    });
    connect(plots_, &PlotsDock::loaded, this,
            [this](const QString& experiment) { session_.select_experiment(experiment.toStdString()); });
    connect(plots_, &PlotsDock::edit_wanted, this, [this](const QString& plot) {
        auto* dock = findChild<QDockWidget*>(QStringLiteral("project"));
        dock->show();
        dock->raise();
        document_->select({widgets::ItemKind::plot, plot});
        document_->editor().setFocus();
    });
}

void MainWindow::connect_benchmarks() {
    connect(benchmarks_, &BenchmarkDock::said, this, [this](const QString& text) { status_->say(text); });
    connect(benchmarks_, &BenchmarkDock::failed, this, [this](const QString& error) {
        messages_->add({Severity::error, "benchmarks", error.toStdString()});
        banners_->show_banner(QStringLiteral("benchmarks"), widgets::BannerStack::Kind::error, error);
    });
}

void MainWindow::show_plot(const std::string& id) {
    auto* dock = findChild<QDockWidget*>(QStringLiteral("plots"));
    dock->show();
    dock->raise();
    plots_->set_visible_to_user(true);
    plots_->show_plot(id);
}

}  // namespace ir::gui
