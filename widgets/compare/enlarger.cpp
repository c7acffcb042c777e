#include "widgets/compare/enlarger.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <algorithm>

namespace ir::widgets {

Enlarger::Enlarger(CompareView& compare, std::function<bool()> is_alone)
    : QObject(&compare), compare_(compare), is_alone_(std::move(is_alone)) {
    auto& panes = compare.panes();
    for (int i = 0; i < panes.pane_count(); ++i) panes.pane(i).installEventFilter(this);
    connect(&panes, &PaneBoard::pane_made, this, [this](ImageView* view) { view->installEventFilter(this); });
}

bool Enlarger::takes_double_click(const ImageView& view) {
    if (is_alone_()) {
        emit back_wanted();
        return true;
    }
    const auto& all = compare_.compared();
    const auto place_in = [&](const std::vector<ImageView*>& views) {
        return std::find(views.begin(), views.end(), &view) - views.begin();
    };
    if (compare_.views().size() < 2) return false;
    const auto pairs = all.pairs();
    const auto picture = place_in(compare_.views()), difference = place_in(compare_.difference_views());
    if (picture < all.count())
        emit alone_wanted({int(picture), StagePair::none});
    else if (difference < std::ptrdiff_t(pairs.size()))
        emit alone_wanted(pairs[std::size_t(difference)]);
    else
        return false;
    return true;
}

/// A view that ends is told so as what is left of it: only events of a live one are looked at.
bool Enlarger::eventFilter(QObject* watched, QEvent* event) {
    const bool is_double_click = event->type() == QEvent::MouseButtonDblClick;
    const bool is_key = event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride;
    if (!is_double_click && !is_key) return false;
    const auto& view = *static_cast<ImageView*>(watched);
    if (view.tool() != ImageView::Tool::inspect) return false;
    if (is_double_click) {
        const auto& click = *static_cast<QMouseEvent*>(event);
        const bool is_free = view.state().light_handle == LightHandle::none && !view.state().has_divider();
        return click.button() == Qt::LeftButton && is_free && takes_double_click(view);
    }
    if (!is_alone_()) return false;
    const auto& key = *static_cast<QKeyEvent*>(event);
    if (key.key() != Qt::Key_Escape || key.modifiers() != Qt::NoModifier) return false;
    event->accept();  // before it is the window's key
    if (event->type() == QEvent::KeyPress) emit back_wanted();
    return true;
}

}  // namespace ir::widgets
