#include "widgets/compare/view_link.h"

#include <algorithm>

namespace ir::widgets {

ViewLink::ViewLink(QObject* parent) : QObject(parent) {}

void ViewLink::add(ImageView* view) {
    if (std::find(views_.begin(), views_.end(), view) != views_.end()) return;
    views_.emplace_back(view);
    connect(view, &ImageView::transform_changed, this, [this, view] {
        leader_ = view;
        if (linked_) align_to(view);
    });
    connect(view, &ImageView::cursor_moved, this, [this, view](QPoint pixel) {
        for (auto* other : followers_of(view))
            other->set_mark(&Marks::cursor, linked_ ? pixel : QPoint(-1, -1));
    });
    connect(view, &ImageView::picked_changed, this, [this, view](QPoint pixel) {
        if (!linked_) return;
        for (auto* other : followers_of(view)) other->set_mark(&Marks::picked, pixel);
    });
}

void ViewLink::remove(ImageView* view) {
    view->disconnect(this);
    view->set_mark(&Marks::cursor, {-1, -1});
    std::erase(views_, view);
}

void ViewLink::clear() {
    while (!views_.empty()) {
        if (views_.back())
            remove(views_.back());
        else
            views_.pop_back();
    }
}

void ViewLink::set_linked(bool linked) {
    if (linked == linked_) return;
    linked_ = linked;
    if (linked && leader_) align_to(leader_);
    for (const auto& view : views_)
        if (!linked && view) view->set_mark(&Marks::cursor, {-1, -1});
}

void ViewLink::align_to(ImageView* view) {
    for (auto* other : followers_of(view)) other->follow(view->transform());
}

std::vector<ImageView*> ViewLink::followers_of(const ImageView* view) const {
    std::vector<ImageView*> followers;
    for (const auto& other : views_)
        if (other && other != view && other->transform().image_size() == view->transform().image_size())
            followers.push_back(other);
    return followers;
}

}  // namespace ir::widgets
