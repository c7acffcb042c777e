#include "app/gui/dock_layout.h"

#include <QAction>
#include <QDockWidget>
#include <QMainWindow>
#include <QMenu>
#include <QScreen>
#include <QSettings>
#include <QStyle>
#include <QTabBar>
#include <QTabWidget>
#include <algorithm>
#include <cstdlib>
#include <utility>

#include "app/gui/actions.h"
#include "renderers/core/error.h"
#include "widgets/views/view_area.h"

namespace ir::gui {
namespace {

/// Of remembered arrangements; that of small screens is another one.
const QString docks_key = QStringLiteral("window/docks"),
              small_docks_key = QStringLiteral("window/small-docks"),
              geometry_key = QStringLiteral("window/geometry");

const QString toggle_prefix = QStringLiteral("dock-");

struct Layout {
    const char* name;
    QStringList docks;            ///< that are shown
    const char* title = nullptr;  ///< in menus; null: only by its name
    widgets::ViewArea::Arrangement views = widgets::ViewArea::Arrangement::one;
    const char* former = nullptr;  ///< name that it had, which still stands in people's scripts
    const char* doc = nullptr;     ///< of the menu's entry, where the title does not say it
    bool compares = false;         ///< begins with a comparison, where there is something to compare
};

const QList<Layout>& layouts() {
    constexpr auto two_views = widgets::ViewArea::Arrangement::side_by_side;
    static const QList<Layout> all = {
        {"default", {"parameters", "project", "display",    "scene",   "buffers",  "inspector", "explain",
                     "metrics",    "timings", "messages",   "results", "plots",    "sweeps",    "analyses",
                     "timeline",   "frames",  "benchmarks", "profile", "pipeline", "shaders"}},
        {"picture", {}},
        {"parameters", {"parameters"}},
        {"compare",
         {"display", "metrics"},
         QT_TR_NOOP("Compare"),
         two_views,
         nullptr,
         QT_TR_NOOP("Both pictures side by side with their metrics; Alt+2 … Alt+6 and Alt+8 show them by "
                    "wipe, lens, flip, difference and in stages"),
         true},
        {"results", {"results"}},
        {"plots", {"plots"}, QT_TR_NOOP("Plots")},
        {"sweeps", {"sweeps"}, QT_TR_NOOP("Sweeps")},
        {"analyses", {"analyses"}, QT_TR_NOOP("Analyses")},
        {"timeline", {"timeline"}},
        {"frames", {"frames"}},
        {"benchmarks", {"benchmarks"}},
        {"profile", {"profile"}},
        {"filters", {"display", "pipeline"}, QT_TR_NOOP("Filters")},
        {"maps",
         {"display", "inspector", "buffers", "explain"},
         QT_TR_NOOP("Layered depth maps"),
         two_views,
         "inspect"},
        {"photons", {"display", "explain", "timings"}, QT_TR_NOOP("Photons"), two_views},
        {"pipeline", {"pipeline"}},
        {"shaders", {"shaders"}},
        {"project", {"project"}},
        {"scene", {"parameters", "scene"}},
    };
    return all;
}

/// Panels beside the views, and where they stand.
constexpr std::pair<const char*, Qt::DockWidgetArea> sides[] = {{"parameters", Qt::LeftDockWidgetArea},
                                                                {"buffers", Qt::RightDockWidgetArea}};
/// By how much a width differs from what it was set to, where separators and rounding took some.
constexpr int width_slack = 12;

/// On a large screen a few words more are read; the views have the most of it in any case.
int side_width(Qt::DockWidgetArea area, int window_width) {
    const int more = std::clamp(window_width / 12 - 110, 0, 160);
    return area == Qt::LeftDockWidgetArea ? 300 + more / 2 : 340 + more;
}

bool is_in_front(const QDockWidget* dock) {
    return dock && dock->isVisible() && !dock->visibleRegion().isEmpty();
}

void focus_into(QWidget* content) {
    for (auto* child : content->findChildren<QWidget*>())
        if (child->isVisible() && child->isEnabled() && (child->focusPolicy() & Qt::TabFocus))
            return child->setFocus(Qt::ShortcutFocusReason);
    content->setFocus(Qt::ShortcutFocusReason);
}

/// How high a panel below the views is where it is opened; 0: as high as the others. Curves, tables, pictures
/// and drawings are as high as a view; the profile leaves more to the pictures that it tells of.
int wanted_height(const QDockWidget& dock, int window_height) {
    static const QStringList tall{"results",  "plots",      "sweeps",  "analyses",
                                  "timeline", "benchmarks", "pipeline"};
    if (tall.contains(dock.objectName())) return window_height / 2;
    if (dock.objectName() == QLatin1String("profile")) return window_height / 3;
    return dock.objectName() == QLatin1String("frames") ? dock.minimumSizeHint().height() : 0;
}

}  // namespace

DockLayout::DockLayout(QMainWindow& window, widgets::ViewArea& views, Actions& actions)
    : window_(window), views_(views), actions_(actions) {
    window_.setDockOptions(QMainWindow::AnimatedDocks | QMainWindow::AllowTabbedDocks |
                           QMainWindow::AllowNestedDocks);
    window_.setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
    window_.setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    window_.setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
    window_.installEventFilter(this);
}

bool DockLayout::eventFilter(QObject* watched, QEvent* event) {
    if (watched == &window_ && event->type() == QEvent::Resize) follow_width();
    return QObject::eventFilter(watched, event);
}

void DockLayout::follow_width() {
    if (is_cramped_ || is_hidden_) return;
    const int before = std::exchange(followed_width_, window_.width());
    for (const auto& [name, area] : sides) {
        const int was = side_width(area, before), is = side_width(area, followed_width_);
        for (auto* each : docks()) {
            if (!is_in_front(each) || each->isFloating() || window_.dockWidgetArea(each) != area) continue;
            if (was != is && std::abs(each->width() - was) <= width_slack)
                window_.resizeDocks({each}, {is}, Qt::Horizontal);
            break;
        }
    }
}

void DockLayout::add(const QString& name, const QString& title, QWidget* content, const QKeySequence& key) {
    auto* dock = new QDockWidget(QString(title).remove(QLatin1Char('&')), &window_);
    dock->setObjectName(name);
    dock->setWidget(content);
    window_.addDockWidget(Qt::RightDockWidgetArea, dock);
    auto* show = actions_.add(toggle_prefix + name, tr("Show %1").arg(title), nullptr, {key},
                              [this, dock] { toggle(dock); });
    show->setCheckable(true);
    connect(dock, &QDockWidget::visibilityChanged, this, &DockLayout::look);
}

/// toggleViewAction() knows of hidden panels alone, not of those that a tab covers.
void DockLayout::toggle(QDockWidget* dock) {
    if (is_in_front(dock)) {
        dock->hide();
    } else {
        open(dock);
        focus_into(dock->widget());
    }
    look();
}

/// One that was closed and shares the bottom with lower ones gets what it wants.
void DockLayout::open(QDockWidget* dock) const {
    const auto is_below = [this](QDockWidget* each) {
        return !each->isFloating() && window_.dockWidgetArea(each) == Qt::BottomDockWidgetArea;
    };
    int high = 0;
    for (auto* each : docks())
        if (is_in_front(each) && is_below(each)) high = std::max(high, each->height());
    const bool was_closed = dock->isHidden();
    dock->show();
    dock->raise();
    const int wanted = wanted_height(*dock, window_.height());
    if (was_closed && wanted > 0 && is_below(dock) && high < std::min(wanted, window_.height() / 3))
        window_.resizeDocks({dock}, {wanted}, Qt::Vertical);
}

QDockWidget* DockLayout::dock(const QString& name) const {
    return window_.findChild<QDockWidget*>(name);
}

QList<QDockWidget*> DockLayout::docks() const {
    return window_.findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly);
}

QAction* DockLayout::toggle_of(const QDockWidget* dock) const {
    return actions_.find(toggle_prefix + dock->objectName());
}

bool DockLayout::is_seen(const QString& name) const {
    return is_in_front(dock(name));
}

void DockLayout::raise(const QString& name) const {
    open(dock(name));
}

void DockLayout::hide(const QString& name) const {
    dock(name)->hide();
}

void DockLayout::fill(QMenu* menu) const {
    for (const auto* each : docks()) menu->addAction(toggle_of(each));
}

void DockLayout::look() {
    const auto check = [this] {
        emit seen_changed();
        for (const auto* dock : docks()) toggle_of(dock)->setChecked(is_in_front(dock));
        // Words that can be read and arrows, rather than eleven times one letter.
        for (auto* tabs : window_.findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
            tabs->setElideMode(Qt::ElideNone);
            tabs->setUsesScrollButtons(true);
        }
    };
    QMetaObject::invokeMethod(this, check, Qt::QueuedConnection);
}

void DockLayout::restore_default() {
    arrange();
    waiting_.clear();
    views_.arrange(widgets::ViewArea::Arrangement::one);
}

void DockLayout::arrange() {
    is_hidden_ = false;
    for (auto* each : docks()) {
        each->setFloating(false);
        window_.removeDockWidget(each);
    }
    const auto dock = [this](const char* name) { return this->dock(QLatin1String(name)); };
    const auto tabify = [&](const char* first, const char* second) {
        window_.tabifyDockWidget(dock(first), dock(second));
    };
    const auto begin_group = [&](const char* name, const char* before) {
        if (is_cramped_) return tabify(before, name);
        window_.addDockWidget(Qt::RightDockWidgetArea, dock(name));
    };
    window_.addDockWidget(Qt::LeftDockWidgetArea, dock("parameters"));
    tabify("parameters", "project");
    begin_group("display", "project");
    tabify("display", "scene");
    begin_group("buffers", "scene");
    tabify("buffers", "inspector");
    tabify("inspector", "explain");
    tabify("explain", "metrics");
    begin_group("timings", "metrics");
    window_.addDockWidget(Qt::BottomDockWidgetArea, dock("messages"));
    tabify("messages", "results");
    tabify("results", "plots");
    tabify("plots", "sweeps");
    tabify("sweeps", "analyses");
    tabify("analyses", "timeline");
    tabify("timeline", "frames");
    tabify("frames", "benchmarks");
    tabify("benchmarks", "profile");
    tabify("profile", "pipeline");
    tabify("pipeline", "shaders");
    for (auto* each : docks()) each->show();
    for (const char* front : {"display", "buffers", "parameters", "messages"}) dock(front)->raise();
    followed_width_ = window_.width();
    for (const auto& [name, area] : sides)
        window_.resizeDocks({dock(name)}, {side_width(area, followed_width_)}, Qt::Horizontal);
    window_.resizeDocks({dock("display"), dock("buffers"), dock("timings")}, {330, 330, 180}, Qt::Vertical);
    window_.resizeDocks({dock("messages")}, {110}, Qt::Vertical);
    // They have something to say only when somebody asks; what is wrong stands in banners.
    for (const char* quiet : {"messages", "results", "plots", "sweeps", "analyses", "timeline", "frames",
                              "benchmarks", "profile", "pipeline", "shaders"})
        dock(quiet)->hide();
}

QStringList DockLayout::names() {
    QStringList names;
    for (const auto& layout : layouts()) names << QLatin1String(layout.name);
    return names;
}

QList<DockLayout::Entry> DockLayout::entries() {
    QList<Entry> entries;
    for (const auto& layout : layouts())
        if (layout.title)
            entries.append(
                {QLatin1String(layout.name), tr(layout.title), layout.doc ? tr(layout.doc) : QString()});
    return entries;
}

void DockLayout::load(const QByteArray& state) {
    hidden_ = state;
    if (!is_hidden_) window_.restoreState(state, dock_version);
}

void DockLayout::hide_all() const {
    for (auto* each : docks()) each->hide();
}

QString DockLayout::present_name(const QString& name) {
    for (const auto& layout : layouts())
        if (name == QLatin1String(layout.name) || (layout.former && name == QLatin1String(layout.former)))
            return QLatin1String(layout.name);
    throw UsageError("unknown layout '" + name.toStdString() + "'; known are " +
                     names().join(QStringLiteral(", ")).toStdString());
}

void DockLayout::apply(const QString& name) {
    const auto& layout = *std::ranges::find(layouts(), present_name(name), &Layout::name);
    arrange();
    waiting_ = layout.compares && !has_project_ ? name : QString();
    const bool compares = layout.compares && has_project_ && compare_ && compare_();
    views_.arrange(compares ? widgets::ViewArea::Arrangement::one : layout.views);
    QList<QDockWidget*> tall;
    for (auto* each : docks()) {
        each->setVisible(layout.docks.contains(each->objectName()));
        if (!each->isHidden() && wanted_height(*each, window_.height()) > 0) tall << each;
    }
    if (tall.size() == 1)
        window_.resizeDocks(tall, {wanted_height(*tall.front(), window_.height())}, Qt::Vertical);
    show(has_project_);
}

QByteArray DockLayout::arrangement() const {
    return is_hidden_ ? hidden_ : window_.saveState(dock_version);
}

void DockLayout::set_cramped(bool cramped) {
    if (cramped == is_cramped_) return;
    is_cramped_ = cramped;
    const auto own = std::exchange(other_, arrangement());
    arrange();
    window_.restoreState(own, dock_version);
    show(has_project_);
}

void DockLayout::show(bool shown) {
    has_project_ = shown;
    if (shown == !is_hidden_) return;
    is_hidden_ = !shown;
    if (shown) {
        window_.restoreState(hidden_, dock_version);
        QMetaObject::invokeMethod(this, &DockLayout::follow_width, Qt::QueuedConnection);
        // Once the project's views are there.
        const auto finish = [this] {
            if (!waiting_.isEmpty()) apply(waiting_);
        };
        if (!waiting_.isEmpty()) QMetaObject::invokeMethod(this, finish, Qt::QueuedConnection);
        return;
    }
    hidden_ = window_.saveState(dock_version);
    for (auto* each : docks()) each->hide();
}

void DockLayout::restore() {
    const QSettings settings;
    window_.restoreGeometry(settings.value(geometry_key).toByteArray());
    window_.restoreState(settings.value(docks_key).toByteArray(), dock_version);
    other_ = settings.value(small_docks_key).toByteArray();
    fit_screen();
}

void DockLayout::remember() const {
    QSettings settings;
    settings.setValue(geometry_key, window_.saveGeometry());
    settings.setValue(docks_key, is_cramped_ ? other_ : arrangement());
    settings.setValue(small_docks_key, is_cramped_ ? arrangement() : other_);
}

void DockLayout::fit_screen() {
    fit(window_.screen()->availableGeometry());
}

void DockLayout::fit(const QRect& available) {
    const int title_bar = window_.style()->pixelMetric(QStyle::PM_TitleBarHeight);
    const QSize room = available.adjusted(0, title_bar, 0, 0).size();
    set_cramped(min_size_for_all_panels.boundedTo(room) != min_size_for_all_panels);
    if (!window_.isMaximized() && !window_.isFullScreen())
        window_.setGeometry(within(window_.geometry(), available, title_bar));
}

QRect within(QRect window, const QRect& available, int title_bar) {
    const QRect room = available.adjusted(0, title_bar, 0, 0);
    window.setSize(window.size().boundedTo(room.size()));
    window.moveLeft(std::clamp(window.left(), room.left(), room.right() + 1 - window.width()));
    window.moveTop(std::clamp(window.top(), room.top(), room.bottom() + 1 - window.height()));
    return window;
}

}  // namespace ir::gui
