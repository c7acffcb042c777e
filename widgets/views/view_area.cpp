#include "widgets/views/view_area.h"

#include <QAction>
#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QLayout>
#include <algorithm>
#include <tuple>
#include <utility>

#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

constexpr int state_version = 1;

std::size_t count_of(ViewArea::Arrangement arrangement) {
    using A = ViewArea::Arrangement;
    return arrangement == A::one ? 1 : arrangement == A::three ? 3 : arrangement == A::four ? 4 : 2;
}

}  // namespace

ViewArea::ViewArea(std::function<QWidget*(int)> make, QWidget* parent)
    : QMainWindow(parent), make_(std::move(make)), views_(max_views, nullptr), titles_(max_views) {
    setWindowFlags(Qt::Widget);
    setDockOptions(AllowTabbedDocks | AllowNestedDocks | AnimatedDocks);
    setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
    setContextMenuPolicy(Qt::PreventContextMenu);
    for (int i = 0; i < max_views; ++i) {
        auto* dock = new QDockWidget(tr("View %1").arg(i + 1), this);
        dock->setObjectName(QStringLiteral("view-%1").arg(i + 1));
        dock->installEventFilter(this);
        connect(dock, &QDockWidget::visibilityChanged, this, [this, i](bool shown) {
            if (shown) ensure(i);
            if (!arranging_) emit views_changed();
        });
        addDockWidget(Qt::LeftDockWidgetArea, dock);
        dock->hide();
        docks_.push_back(dock);
    }
    connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, QWidget* now) { follow_focus(now); });
    arrange(Arrangement::one);
}

void ViewArea::ensure(int number) {
    auto& view = views_[std::size_t(number)];
    if (view) return;
    view = make_(number);
    docks_[std::size_t(number)]->setWidget(view);
}

// Hidden behind a tab is open, too; so visibility is no answer.
bool ViewArea::is_open(int number) const {
    return !docks_[std::size_t(number)]->isHidden();
}

std::vector<int> ViewArea::open_views() const {
    std::vector<int> open;
    for (int i = 0; i < max_views; ++i)
        if (is_open(i)) open.push_back(i);
    return open;
}

void ViewArea::set_active(int number) {
    if (number < 0 || number >= max_views || !is_open(number)) return;
    const bool changed = number != active_;
    active_ = number;
    mark_active();
    if (changed) emit active_changed(number);
}

/// A view is in the line of the uppermost one if it begins above that one's middle. Views behind a tab stand
/// where the tab is, floating ones come last.
std::vector<int> ViewArea::as_one_reads() const {
    struct Place {
        int view;
        QRect where;
    };
    std::vector<Place> left;
    std::vector<int> order, floating;
    for (const int view : open_views()) {
        if (dock(view)->isFloating()) {
            floating.push_back(view);
            continue;
        }
        QRect where = dock(view)->geometry();
        for (const auto* each : tabifiedDockWidgets(dock(view)))
            if (where.right() < 0 || where.bottom() < 0) where = each->geometry();
        left.push_back({view, where});
    }
    const auto is_above = [](const Place& a, const Place& b) {
        return std::tuple(a.where.top(), a.where.left(), a.view) <
               std::tuple(b.where.top(), b.where.left(), b.view);
    };
    const auto is_before = [](const Place& a, const Place& b) {
        return std::tuple(a.where.left(), a.where.top(), a.view) <
               std::tuple(b.where.left(), b.where.top(), b.view);
    };
    while (!left.empty()) {
        const int middle = std::min_element(left.begin(), left.end(), is_above)->where.center().y();
        const auto below = std::partition(left.begin(), left.end(),
                                          [&](const Place& each) { return each.where.top() < middle; });
        std::sort(left.begin(), below, is_before);
        for (auto each = left.begin(); each != below; ++each) order.push_back(each->view);
        left.erase(left.begin(), below);
    }
    order.insert(order.end(), floating.begin(), floating.end());
    return order;
}

int ViewArea::number_of(int view) const {
    const auto order = as_one_reads();
    const auto found = std::find(order.begin(), order.end(), view);
    return found == order.end() ? 0 : int(found - order.begin()) + 1;
}

void ViewArea::set_title(int view, const QString& title) {
    titles_[std::size_t(view)] = title;
    number_titles();
}

void ViewArea::number_titles() {
    int number = 0;
    for (const int view : as_one_reads()) {
        const QString& title = titles_[std::size_t(view)];
        ++number;
        dock(view)->setWindowTitle(title.isEmpty() ? tr("View %1").arg(number)
                                                   : tr("%1  %2").arg(number).arg(title));
    }
}

/// Once the layout has come to rest.
void ViewArea::number_soon() {
    if (std::exchange(numbering_, true)) return;
    QMetaObject::invokeMethod(
        this,
        [this] {
            numbering_ = false;
            number_titles();
        },
        Qt::QueuedConnection);
}

void ViewArea::mark_active() {
    const bool several = open_views().size() > 1;
    for (int i = 0; i < max_views; ++i) {
        auto* dock = docks_[std::size_t(i)];
        dock->setProperty(active_dock_property, several && i == active_);
        dock->update();
    }
}

void ViewArea::follow_focus(QWidget* now) {
    for (int i = 0; i < max_views; ++i)
        if (now && docks_[std::size_t(i)]->isAncestorOf(now)) return set_active(i);
}

void ViewArea::take_all_out() {
    for (auto* dock : docks_) {
        dock->setFloating(false);
        dock->hide();  // one that was removed while it was seen is saved, and restored, as if it were seen
        removeDockWidget(dock);
    }
}

void ViewArea::arrange(Arrangement arrangement) {
    arranging_ = true;
    const auto count = count_of(arrangement);
    take_all_out();
    if (arrangement == Arrangement::one) {  // what one works with stays
        ensure(active_);
        addDockWidget(Qt::LeftDockWidgetArea, dock(active_));
        dock(active_)->show();
        arranging_ = false;
        mark_active();
        emit views_changed();
        return;
    }
    for (std::size_t i = 0; i < count; ++i) ensure(int(i));
    addDockWidget(Qt::LeftDockWidgetArea, dock(0));
    using A = Arrangement;
    if (arrangement == A::side_by_side || arrangement == A::three || arrangement == A::four)
        splitDockWidget(dock(0), dock(1), Qt::Horizontal);
    if (arrangement == A::stacked) splitDockWidget(dock(0), dock(1), Qt::Vertical);
    if (arrangement == A::three) splitDockWidget(dock(1), dock(2), Qt::Vertical);
    if (arrangement == A::four) {  // numbered as one reads
        splitDockWidget(dock(0), dock(2), Qt::Vertical);
        splitDockWidget(dock(1), dock(3), Qt::Vertical);
    }
    for (std::size_t i = 0; i < count; ++i) dock(int(i))->show();
    if (count > 1 && arrangement != A::stacked)
        resizeDocks({dock(0), dock(1)}, {width() / 2, width() / 2}, Qt::Horizontal);
    if (arrangement == A::stacked)
        resizeDocks({dock(0), dock(1)}, {height() / 2, height() / 2}, Qt::Vertical);
    if (arrangement == A::three) resizeDocks({dock(1), dock(2)}, {height() / 2, height() / 2}, Qt::Vertical);
    if (arrangement == A::four)
        for (const int left : {0, 1})
            resizeDocks({dock(left), dock(left + 2)}, {height() / 2, height() / 2}, Qt::Vertical);
    arranging_ = false;
    if (!is_open(active_)) set_active(0);
    mark_active();
    emit views_changed();
}

int ViewArea::open_another() {
    for (int i = 0; i < max_views; ++i)
        if (!is_open(i)) {
            open(i);
            return i;
        }
    return -1;
}

void ViewArea::open(int number) {
    if (!is_open(number)) {
        arranging_ = true;
        ensure(number);
        auto* beside = dock(active_);
        if (beside->isFloating()) beside = nullptr;
        removeDockWidget(dock(number));
        addDockWidget(Qt::LeftDockWidgetArea, dock(number));
        layout()->activate();  // views that were opened or closed just now have their sizes
        const QSize room = beside ? beside->size() : QSize();
        const auto way = room.width() >= room.height() ? Qt::Horizontal : Qt::Vertical;
        if (beside) splitDockWidget(beside, dock(number), way);
        dock(number)->show();
        const int half = (way == Qt::Horizontal ? room.width() : room.height()) / 2;
        if (beside) resizeDocks({beside, dock(number)}, {half, half}, way);
        arranging_ = false;
        emit views_changed();
    }
    set_active(number);
}

void ViewArea::close_view(int number) {
    if (is_open(number)) dock(number)->close();
}

void ViewArea::step_active(int step) {
    const auto open = as_one_reads();
    if (open.empty()) return;
    std::size_t at = 0;
    for (std::size_t i = 0; i < open.size(); ++i)
        if (open[i] == active_) at = i;
    go_to(open[(at + open.size() + std::size_t(step + int(open.size()))) % open.size()]);
}

void ViewArea::go_to(int number) {
    dock(number)->raise();
    if (view(number)) view(number)->setFocus();
    set_active(number);
}

QByteArray ViewArea::save() const {
    return saveState(state_version);
}

bool ViewArea::restore(const QByteArray& state) {
    arranging_ = true;
    take_all_out();  // what the state does not name would stay open where it is
    const bool restored = restoreState(state, state_version);
    for (int i = 0; i < max_views; ++i)
        if (is_open(i)) ensure(i);
    arranging_ = false;
    if (!restored || open_views().empty()) {
        arrange(Arrangement::one);
        return false;
    }
    if (!is_open(active_)) set_active(open_views().front());
    mark_active();
    emit views_changed();
    return true;
}

bool ViewArea::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::MouseButtonPress)
        for (int i = 0; i < max_views; ++i)
            if (dock(i) == watched) set_active(i);
    if (event->type() == QEvent::Close && open_views().size() < 2) {
        event->ignore();  // a window without any view shows nothing
        return true;
    }
    const auto type = event->type();
    if (type == QEvent::Move || type == QEvent::Resize || type == QEvent::Show || type == QEvent::Hide)
        number_soon();
    if (event->type() == QEvent::Close || event->type() == QEvent::Hide) {
        // The dock hides itself after this.
        QMetaObject::invokeMethod(
            this,
            [this] {
                if (!is_open(active_) && !open_views().empty()) set_active(open_views().front());
                mark_active();
            },
            Qt::QueuedConnection);
    }
    return QMainWindow::eventFilter(watched, event);
}

}  // namespace ir::widgets
