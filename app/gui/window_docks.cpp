#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QScrollArea>
#include <QStatusBar>
#include <QTabWidget>
#include <QToolButton>
#include <QTreeView>
#include <QVBoxLayout>

#include "app/gui/main_window.h"
#include "renderers/core/error.h"
#include "widgets/models/report_rows.h"
#include "widgets/style/icons.h"

namespace ir::gui {
namespace {

struct Layout {
    const char* name;
    QStringList docks;  ///< that are shown
};

const QList<Layout>& layouts() {
    static const QList<Layout> all = {
        {"default", {"parameters", "scene", "buffers", "timings", "messages"}},
        {"picture", {}},
        {"parameters", {"parameters"}},
        {"inspect", {"buffers", "timings", "messages"}},
        {"scene", {"parameters", "scene"}},
    };
    return all;
}

}  // namespace

QDockWidget* MainWindow::add_dock(const QString& name, const QString& title, QWidget* content,
                                  Qt::DockWidgetArea area, const QKeySequence& key) {
    auto* dock = new QDockWidget(title, this);
    dock->setObjectName(name);
    dock->setWidget(content);
    addDockWidget(area, dock);
    dock->toggleViewAction()->setShortcut(key);
    dock->toggleViewAction()->setText(tr("Show %1").arg(title));
    return dock;
}

void MainWindow::make_parameter_dock() {
    experiment_panel_ = new widgets::ExperimentPanel;
    parameter_panel_ = new widgets::ParameterPanel;
    auto* filter = new QLineEdit;
    filter->setPlaceholderText(tr("Filter parameters"));
    filter->setClearButtonEnabled(true);
    connect(filter, &QLineEdit::textChanged, parameter_panel_, &widgets::ParameterPanel::set_filter);
    auto* content = new QWidget;
    auto* layout = new QVBoxLayout(content);
    layout->setContentsMargins(4, 4, 4, 4);
    layout->setSpacing(4);
    layout->addWidget(experiment_panel_);
    layout->addWidget(filter);
    layout->addWidget(parameter_panel_);
    layout->addStretch(1);
    auto* scroll = new QScrollArea;
    scroll->setWidget(content);
    scroll->setWidgetResizable(true);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setMinimumWidth(356);
    add_dock("parameters", tr("Parameters"), scroll, Qt::LeftDockWidgetArea, Qt::CTRL | Qt::Key_1);
}

void MainWindow::make_docks() {
    setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
    make_parameter_dock();
    scene_tree_ = new widgets::RowsPanel(widgets::scene_headings(), tr("No scene is open."));
    buffers_ = new widgets::RowsPanel(widgets::buffer_headings(),
                                      tr("Buffers appear when a frame has been rendered."));
    buffers_->set_picture_size(QSize(48, 32));
    buffers_->set_name_width(190);
    buffers_->setMinimumWidth(260);
    timings_ = new widgets::RowsPanel(widgets::timing_headings(),
                                      tr("Times appear when a frame has been rendered."));
    timings_->view()->setRootIsDecorated(false);
    timings_->set_name_width(80);
    counters_ =
        new widgets::RowsPanel(widgets::counter_headings(), tr("This method has counted nothing yet."));
    counters_->view()->setRootIsDecorated(false);
    messages_ = new widgets::MessagesPanel;
    auto* numbers = new QTabWidget;
    numbers->setDocumentMode(true);
    numbers->addTab(timings_, tr("Passes"));
    numbers->addTab(counters_, tr("Counters"));
    add_dock("scene", tr("Scene"), scene_tree_, Qt::RightDockWidgetArea, Qt::CTRL | Qt::Key_2);
    add_dock("buffers", tr("Buffers"), buffers_, Qt::RightDockWidgetArea, Qt::CTRL | Qt::Key_3);
    add_dock("timings", tr("Timings"), numbers, Qt::RightDockWidgetArea, Qt::CTRL | Qt::Key_4);
    add_dock("messages", tr("Messages"), messages_, Qt::BottomDockWidgetArea, Qt::CTRL | Qt::Key_5);
    connect(findChild<QDockWidget*>("buffers"), &QDockWidget::visibilityChanged, this,
            [this](bool shown) { session_.set_thumbnails_wanted(shown); });
}

void MainWindow::make_status_bar() {
    state_label_ = new QLabel;
    state_label_->setObjectName(QStringLiteral("state"));
    state_label_->setMinimumWidth(1);
    progress_ = new QProgressBar;
    progress_->setRange(0, 1000);
    progress_->setMaximumWidth(180);
    progress_->setMaximumHeight(14);
    progress_->setTextVisible(false);
    cancel_button_ = new QToolButton;
    cancel_button_->setIcon(widgets::icon("cancel"));
    cancel_button_->setAutoRaise(true);
    cancel_button_->setToolTip(tr("Cancel rendering (Esc)"));
    cancel_button_->setAccessibleName(tr("Cancel rendering"));
    connect(cancel_button_, &QToolButton::clicked, this, [this] { session_.cancel(); });
    device_label_ = new QLabel(tr("starting …"));
    device_label_->setObjectName(QStringLiteral("device"));
    statusBar()->addWidget(state_label_, 1);
    statusBar()->addWidget(progress_);
    statusBar()->addWidget(cancel_button_);
    statusBar()->addPermanentWidget(device_label_);
}

void MainWindow::restore_default_layout() {
    hidden_docks_.clear();
    for (auto* dock : findChildren<QDockWidget*>()) {
        dock->setFloating(false);
        removeDockWidget(dock);
    }
    const auto dock = [this](const char* name) { return findChild<QDockWidget*>(QLatin1String(name)); };
    addDockWidget(Qt::LeftDockWidgetArea, dock("parameters"));
    addDockWidget(Qt::RightDockWidgetArea, dock("scene"));
    addDockWidget(Qt::RightDockWidgetArea, dock("buffers"));
    addDockWidget(Qt::RightDockWidgetArea, dock("timings"));
    addDockWidget(Qt::BottomDockWidgetArea, dock("messages"));
    for (auto* each : findChildren<QDockWidget*>()) each->show();
    resizeDocks({dock("parameters"), dock("buffers")}, {360, 430}, Qt::Horizontal);
    resizeDocks({dock("scene"), dock("buffers"), dock("timings")}, {200, 330, 220}, Qt::Vertical);
    resizeDocks({dock("messages")}, {120}, Qt::Vertical);
}

QStringList MainWindow::layout_names() {
    QStringList names;
    for (const auto& layout : layouts()) names << QLatin1String(layout.name);
    return names;
}

void MainWindow::apply_layout(const QString& name) {
    for (const auto& layout : layouts()) {
        if (name != QLatin1String(layout.name)) continue;
        restore_default_layout();
        for (auto* dock : findChildren<QDockWidget*>())
            dock->setVisible(layout.docks.contains(dock->objectName()));
        if (!session_.has_project()) show_docks(false);
        return;
    }
    throw UsageError("unknown layout '" + name.toStdString() + "'; known are " +
                     layout_names().join(QStringLiteral(", ")).toStdString());
}

void MainWindow::show_docks(bool shown) {
    if (shown == hidden_docks_.isEmpty()) return;
    if (shown) {
        restoreState(hidden_docks_, dock_version);
        hidden_docks_.clear();
        return;
    }
    hidden_docks_ = saveState(dock_version);
    for (auto* dock : findChildren<QDockWidget*>()) dock->hide();
}

void MainWindow::restore_window() {
    resize(1440, 900);
    restore_default_layout();
    if (!options_.remember) return;
    const QSettings settings;
    restoreGeometry(settings.value(QStringLiteral("window/geometry")).toByteArray());
    restoreState(settings.value(QStringLiteral("window/docks")).toByteArray(), dock_version);
}

}  // namespace ir::gui
