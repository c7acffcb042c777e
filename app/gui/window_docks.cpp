#include <QAction>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QScreen>
#include <QScrollArea>
#include <QStackedWidget>
#include <QStatusBar>
#include <QStyle>
#include <QTabWidget>
#include <QTreeView>
#include <QVBoxLayout>
#include <utility>

#include "app/gui/main_window.h"
#include "app/gui/window_geometry.h"
#include "renderers/core/error.h"
#include "widgets/models/report_rows.h"

namespace ir::gui {
namespace {

/// Of remembered arrangements; that of small screens is another one.
const QString docks_key = QStringLiteral("window/docks"),
              small_docks_key = QStringLiteral("window/small-docks");

struct Layout {
    const char* name;
    QStringList docks;  ///< that are shown
};

const QList<Layout>& layouts() {
    static const QList<Layout> all = {
        {"default",
         {"parameters", "project", "display", "scene", "buffers", "inspector", "explain", "metrics",
          "timings", "messages", "results", "plots", "timeline", "benchmarks"}},
        {"picture", {}},
        {"parameters", {"parameters"}},
        {"compare", {"display", "metrics"}},
        {"results", {"results"}},
        {"plots", {"plots"}},
        {"timeline", {"timeline"}},
        {"benchmarks", {"benchmarks"}},
        {"inspect", {"display", "inspector", "buffers", "explain"}},
        {"project", {"project"}},
        {"scene", {"parameters", "scene"}},
    };
    return all;
}

QList<QDockWidget*> docks_of(const QMainWindow* window) {
    return window->findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly);
}

/// Neither hidden nor covered by another tab.
bool is_in_front(const QDockWidget* dock) {
    return dock && dock->isVisible() && !dock->visibleRegion().isEmpty();
}

void focus_into(QWidget* content) {
    for (auto* child : content->findChildren<QWidget*>())
        if (child->isVisible() && child->isEnabled() && (child->focusPolicy() & Qt::TabFocus))
            return child->setFocus(Qt::ShortcutFocusReason);
    content->setFocus(Qt::ShortcutFocusReason);
}

/// Its size is asked neither of the panels that share its place nor of the window.
QScrollArea* scrolled(QWidget* panel) {
    auto* scroll = new QScrollArea;
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setWidget(panel);
    scroll->setWidgetResizable(true);
    return scroll;
}

/// toggleViewAction() knows of hidden panels alone, not of those that a tab covers.
void toggle_dock(QDockWidget* dock) {
    if (is_in_front(dock)) return dock->hide();
    dock->show();
    dock->raise();
    focus_into(dock->widget());
}

}  // namespace

void MainWindow::make_centre() {
    auto* centre = new QWidget;
    auto* layout = new QVBoxLayout(centre);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    banners_ = new widgets::BannerStack;
    layout->addWidget(banners_);
    pages_ = new QStackedWidget;
    layout->addWidget(pages_, 1);
    welcome_ = new widgets::WelcomePage;
    pages_->addWidget(welcome_);
    pages_->addWidget(&workspace_.area());
    setCentralWidget(centre);
    if (options_.surface == widgets::ImageView::Surface::best && !widgets::has_opengl())
        banners_->show_banner(QStringLiteral("opengl"), widgets::BannerStack::Kind::note,
                              tr("This screen offers no OpenGL 3.3; pictures are painted by the processor. "
                                 "All functions work, only slower."));
}

QDockWidget* MainWindow::add_dock(const QString& name, const QString& title, QWidget* content,
                                  const QKeySequence& key) {
    auto* dock = new QDockWidget(title, this);
    dock->setObjectName(name);
    dock->setWidget(content);
    addDockWidget(Qt::RightDockWidgetArea, dock);
    auto* show = new QAction(tr("Show %1").arg(title), this);
    show->setCheckable(true);
    show->setShortcut(key);
    connect(show, &QAction::triggered, this, [this, dock] {
        toggle_dock(dock);
        watch_docks();
    });
    actions_.insert(QStringLiteral("dock-") + name, show);
    connect(dock, &QDockWidget::visibilityChanged, this, &MainWindow::watch_docks);
    return dock;
}

QWidget* MainWindow::make_parameter_dock() {
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
    scroll->setMinimumWidth(350);
    return scroll;
}

QWidget* MainWindow::make_timings_dock() {
    timings_ = new widgets::RowsPanel(widgets::timing_headings(),
                                      tr("Times appear when a frame has been rendered."));
    timings_->view()->setRootIsDecorated(false);
    timings_->set_name_width(80);
    counters_ =
        new widgets::RowsPanel(widgets::counter_headings(), tr("This method has counted nothing yet."));
    counters_->view()->setRootIsDecorated(false);
    auto* numbers = new QTabWidget;
    numbers->setDocumentMode(true);
    numbers->addTab(timings_, tr("Passes"));
    numbers->addTab(counters_, tr("Counters"));
    return numbers;
}

void MainWindow::make_docks() {
    setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
    document_ = new DocumentDock(session_, scenes_, workspace_);
    results_ = new ResultsDock(session_, live_, renderer_, workspace_, kept_);
    plots_ = new PlotsDock(session_, options_.machine, options_.study_runner);
    display_ = new widgets::DisplayPanel;
    display_->setMinimumWidth(300);
    scene_tree_ = new widgets::RowsPanel(widgets::scene_headings(), tr("No scene is open."));
    buffers_ = new widgets::RowsPanel(widgets::buffer_headings(),
                                      tr("Buffers appear when a frame has been rendered."));
    buffers_->set_picture_size(QSize(48, 32));
    buffers_->set_name_width(190);
    buffers_->setMinimumWidth(240);
    messages_ = new widgets::MessagesPanel;
    const auto key = [](Qt::Key digit) { return QKeySequence(Qt::CTRL | digit); };
    add_dock("parameters", tr("Parameters"), make_parameter_dock(), key(Qt::Key_1));
    add_dock("project", tr("Project"), document_, key(Qt::Key_2));
    add_dock("display", tr("Display"), display_, key(Qt::Key_3));
    add_dock("scene", tr("Scene"), scene_tree_, key(Qt::Key_4));
    add_dock("buffers", tr("Buffers"), buffers_, key(Qt::Key_5));
    add_dock("inspector", tr("Inspector"), &inspector_.panel(), key(Qt::Key_6));
    add_dock("explain", tr("Explain"), &inspector_.explain_panel(), key(Qt::Key_7));
    add_dock("metrics", tr("Metrics"), &metrics_.panel(), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_M));
    add_dock("timings", tr("Timings"), make_timings_dock(), key(Qt::Key_8));
    add_dock("messages", tr("Messages"), messages_, key(Qt::Key_9));
    add_dock("results", tr("Results"), results_, QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_R));
    add_dock("plots", tr("Plots"), scrolled(plots_), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_G));
    benchmarks_ =
        new BenchmarkDock(session_, options_.benchmark_runner ? options_.benchmark_runner
                                                              : engine::benchmark_runner(options_.machine));
    timeline_ = new TimelineDock(session_, live_, playback_);
    add_dock("timeline", tr("Timeline"), scrolled(timeline_), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_T));
    add_dock("benchmarks", tr("Benchmarks"), benchmarks_, QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_B));
}

/// Panels behind tabs and closed ones ask for nothing.
void MainWindow::watch_docks() {
    const auto seen = [this](const char* name) {
        return is_in_front(findChild<QDockWidget*>(QLatin1String(name)));
    };
    QMetaObject::invokeMethod(
        this,
        [this, seen] {
            inspector_.set_visible(seen("inspector"), seen("explain"));
            inspector_.set_thumbnails_wanted(seen("buffers"));
            results_->set_visible_to_user(seen("results"));
            plots_->set_visible_to_user(seen("plots"));
            metrics_.set_visible(seen("metrics"));
            for (const auto* dock : docks_of(this))
                if (auto* show = action(QStringLiteral("dock-") + dock->objectName()))
                    show->setChecked(is_in_front(dock));
        },
        Qt::QueuedConnection);
}

void MainWindow::make_status_bar() {
    status_ = new StatusLine(session_, live_);
    connect(status_, &StatusLine::cancel_wanted, this, [this] { live_.cancel(); });
    device_label_ = new QLabel(tr("starting …"));
    device_label_->setObjectName(QStringLiteral("device"));
    statusBar()->addWidget(status_, 1);
    statusBar()->addPermanentWidget(device_label_);
}

void MainWindow::restore_default_layout() {
    arrange_docks();
    workspace_.area().arrange(widgets::ViewArea::Arrangement::one);
}

void MainWindow::arrange_docks() {
    has_hidden_docks_ = false;
    for (auto* dock : docks_of(this)) {
        dock->setFloating(false);
        removeDockWidget(dock);
    }
    const auto dock = [this](const char* name) { return findChild<QDockWidget*>(QLatin1String(name)); };
    addDockWidget(Qt::LeftDockWidgetArea, dock("parameters"));
    tabifyDockWidget(dock("parameters"), dock("project"));
    const auto begin_group = [&](const char* name, const char* before) {
        if (is_cramped_) return tabifyDockWidget(dock(before), dock(name));
        addDockWidget(Qt::RightDockWidgetArea, dock(name));
    };
    begin_group("display", "project");
    tabifyDockWidget(dock("display"), dock("scene"));
    begin_group("buffers", "scene");
    tabifyDockWidget(dock("buffers"), dock("inspector"));
    tabifyDockWidget(dock("inspector"), dock("explain"));
    tabifyDockWidget(dock("explain"), dock("metrics"));
    begin_group("timings", "metrics");
    addDockWidget(Qt::BottomDockWidgetArea, dock("messages"));
    tabifyDockWidget(dock("messages"), dock("results"));
    tabifyDockWidget(dock("results"), dock("plots"));
    tabifyDockWidget(dock("plots"), dock("timeline"));
    tabifyDockWidget(dock("timeline"), dock("benchmarks"));
    for (auto* each : docks_of(this)) each->show();
    for (const char* front : {"display", "buffers", "parameters", "messages"}) dock(front)->raise();
    resizeDocks({dock("parameters"), dock("buffers")}, {350, 400}, Qt::Horizontal);
    resizeDocks({dock("display"), dock("buffers"), dock("timings")}, {330, 330, 180}, Qt::Vertical);
    resizeDocks({dock("messages")}, {110}, Qt::Vertical);
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
        for (auto* dock : docks_of(this)) dock->setVisible(layout.docks.contains(dock->objectName()));
        if (name == QLatin1String("plots") || name == QLatin1String("benchmarks"))
            resizeDocks({findChild<QDockWidget*>(name)}, {height() / 2}, Qt::Vertical);
        if (!session_.has_project()) show_docks(false);
        return;
    }
    throw UsageError("unknown layout '" + name.toStdString() + "'; known are " +
                     layout_names().join(QStringLiteral(", ")).toStdString());
}

QByteArray MainWindow::docks() const {
    return has_hidden_docks_ ? hidden_docks_ : saveState(dock_version);
}

void MainWindow::set_cramped(bool cramped) {
    if (cramped == is_cramped_) return;
    is_cramped_ = cramped;
    const auto own = std::exchange(other_docks_, docks());
    arrange_docks();
    restoreState(own, dock_version);
    if (!session_.has_project()) show_docks(false);
}

void MainWindow::show_docks(bool shown) {
    if (shown == !has_hidden_docks_) return;
    has_hidden_docks_ = !shown;
    if (shown) {
        restoreState(hidden_docks_, dock_version);
        return;
    }
    hidden_docks_ = saveState(dock_version);
    for (auto* dock : docks_of(this)) dock->hide();
}

void MainWindow::restore_window() {
    resize(1440, 900);
    restore_default_layout();
    if (!options_.remember) return;
    const QSettings settings;
    restoreGeometry(settings.value(QStringLiteral("window/geometry")).toByteArray());
    restoreState(settings.value(docks_key).toByteArray(), dock_version);
    other_docks_ = settings.value(small_docks_key).toByteArray();
    fit_screen();
}

void MainWindow::remember_window() const {
    if (!options_.remember) return;
    QSettings settings;
    settings.setValue(QStringLiteral("window/geometry"), saveGeometry());
    settings.setValue(docks_key, is_cramped_ ? other_docks_ : docks());
    settings.setValue(small_docks_key, is_cramped_ ? docks() : other_docks_);
}

void MainWindow::fit_screen() {
    fit(screen()->availableGeometry());
}

void MainWindow::fit(const QRect& available) {
    const int title_bar = style()->pixelMetric(QStyle::PM_TitleBarHeight);
    const QSize room = available.adjusted(0, title_bar, 0, 0).size();
    set_cramped(least_for_all_panels.boundedTo(room) != least_for_all_panels);
    if (!isMaximized() && !isFullScreen()) setGeometry(within(geometry(), available, title_bar));
}

}  // namespace ir::gui
