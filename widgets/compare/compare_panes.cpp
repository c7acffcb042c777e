#include <algorithm>
#include <cmath>

#include "renderers/image/enlarge.h"
#include "widgets/compare/compare_view.h"
#include "widgets/compare/difference_worker.h"
#include "widgets/compare/one_size.h"
#include "widgets/compare/significance.h"
#include "widgets/compare/view_link.h"

/// What the panes of a comparison show.
namespace ir::widgets {

QString CompareView::letter_of(int picture) {
    return picture < 26 ? QString(QChar('A' + picture)) : QString::number(picture + 1);
}

std::vector<CompareView::Content> CompareView::contents() const {
    if (mode_ == Mode::difference && held_ < 0) return {{0, true}};
    if ((mode_ != Mode::side_by_side && mode_ != Mode::stages) || count() < 2)
        return {{shown_picture(), false}};
    std::vector<Content> contents;
    for (int i = 0; i < count(); ++i) contents.push_back({i, false});
    for (int i = 0; has_rows() && i + 1 < count(); ++i) contents.push_back({i, true, i});
    if (has_pair()) {
        contents.push_back({pair_.b, false, pair_slot});
        contents.push_back({pair_.a, true, pair_slot});
    }
    return contents;
}

QString CompareView::size_refusal() const {
    const bool each_for_itself =
        count() > 2 || (count() == 2 && have_difference(*pictures_[0], *pictures_[1]));
    if (mode_ == Mode::stages && each_for_itself) return {};
    const Picture* first = nullptr;
    int index = 0;
    const int compared = mode_ == Mode::wipe || mode_ == Mode::difference ? std::min(2, count()) : count();
    for (int i = 0; i < compared; ++i) {
        const Picture& each = *pictures_[i];
        if (!each.has_image()) continue;
        if (!first) {
            first = &each;
            index = i;
        } else if (each.size() != first->size()) {
            const QString sizes =
                tr("Sizes differ: %1 has %2, %3 has %4 pixels. ")
                    .arg(letter_of(index), size_text(*first), letter_of(i), size_text(each));
            return sizes + (mode_ == Mode::side_by_side
                                ? tr("Render both at one size, or unlink the views to see both.")
                                : tr("Render both at one size to compare them."));
        }
    }
    return {};
}

QString CompareView::missing_picture() const {
    for (int i = 0; i < std::min(2, count()); ++i)
        if (!pictures_[i]->has_image())
            return pictures_[i]->note.isEmpty() ? tr("%1 has no picture yet.").arg(letter_of(i))
                                                : tr("%1: %2").arg(letter_of(i), pictures_[i]->note);
    return {};
}

QString CompareView::refusal() const {
    if (mode_ == Mode::single) return {};
    if (count() < 2) return tr("Choose a second picture to compare with.");
    if (mode_ == Mode::wipe || mode_ == Mode::difference)
        if (const QString missing = missing_picture(); !missing.isEmpty()) return missing;
    if (mode_ == Mode::side_by_side && !is_linked()) return {};
    const QString sizes = size_refusal();
    return sizes.isEmpty() ? noise_refusal() : sizes;
}

QString CompareView::missing() const {
    for (std::size_t i = 0; i < contents().size(); ++i)
        if (!panes_[i]->state().note.isEmpty()) return panes_[i]->state().note;
    return {};
}

QString CompareView::noise_refusal() const {
    if (kind_ != DifferenceKind::significant || mode_ != Mode::difference || count() < 2) return {};
    const Picture &a = *pictures_[0], &b = *pictures_[1];
    if (a.awaits_variance || b.awaits_variance) return tr("Waiting for the variance …");
    if (has_variance(a) || has_variance(b)) return {};
    return tr("Neither A nor B comes with its variance, so noise cannot be told from error. %1")
        .arg(noise_hint_.isEmpty() ? tr("Compare with a result of a method that estimates it.")
                                   : noise_hint_);
}

QString CompareView::difference_text(QPoint pixel) const {
    const auto shown = difference_picture();
    if (kind_ != DifferenceKind::significant || !shown || count() < 2) return {};
    const QString numbers = significance_text(*pictures_[0], *pictures_[1], pixel);
    if (numbers.isEmpty() || shown->size() != pictures_[0]->size()) return numbers;
    bool explained = true;
    for (int c = 0; c < shown->image->channels; ++c)
        explained &= shown->image->at(pixel.x(), pixel.y(), c) == 0;
    return numbers + QStringLiteral("   ") + (explained ? tr("within noise") : tr("significant"));
}

void CompareView::update_regions() {
    for (auto* view : panes_) {
        const auto& picture = view->picture();
        const bool fits = picture && picture->size() == region_size_;
        view->set_mark(&Marks::region, fits ? region_ : QRect());
    }
}

void CompareView::mark(ImageView& view) const {
    const auto& picture = view.picture();
    const QSize size = picture ? picture->size() : QSize(), of = picked_size_;
    if (picked_.x() < 0 || of.isEmpty() || size.isEmpty() || size == of)
        return view.set_mark(&Marks::picked, picked_);
    const bool alike =
        picture->atlas.tiles.empty() && (is_reduced(size.width(), size.height(), of.width(), of.height()) ||
                                         is_reduced(of.width(), of.height(), size.width(), size.height()));
    view.set_mark(&Marks::picked, alike ? pixel_at_size(picked_, of, size) : QPoint(-1, -1));
}

QString CompareView::pane_label(int picture) const {
    if (count() < 2) return {};
    const QString &label = stage(picture).label, name = stage_name(picture);
    return label.isEmpty() ? name : name + QStringLiteral("   ") + label;
}

void CompareView::refresh() {
    const auto shown = contents();
    const bool refused = held_ < 0 && count() >= 2 && !refusal().isEmpty();
    if (!refused) request_differences();
    for (int i = 0; i < int(shown.size()); ++i) {
        auto& view = *pane(i);
        const QSizeF before = view.transform().image_size();
        fill(view, shown[i]);
        if (view.transform().image_size() != before) mark(view);
    }
    for (std::size_t i = shown.size(); i < panes_.size(); ++i) {
        panes_[i]->hide();
        panes_[i]->set_picture(nullptr);
    }
    if (active_pane_ >= int(shown.size())) active_pane_ = 0;
    place();
    update_regions();
    update_legends();
    update_bar();
    relink();
}

void CompareView::fill(ImageView& pane, const Content& content) {
    if (mode_ != Mode::wipe || held_ >= 0) pane.set_second(nullptr);
    if (content.picture >= count()) {
        pane.set_picture(nullptr);
        return pane.set_labels({});
    }
    const QString reason = held_ < 0 ? refusal() : QString();
    // Side by side A stays and the reason stands in the place of what does not fit.
    const bool fits =
        mode_ == Mode::side_by_side && stage(content.picture).size() == pictures_.front()->size();
    const bool alone = count() < 2 && mode_ != Mode::difference;
    if (!reason.isEmpty() && !fits && !alone) {
        pane.set_second(nullptr);
        pane.set_picture(make_note(reason));
        return pane.set_labels(content.difference ? QString() : pane_label(content.picture));
    }
    if (content.difference) return fill_difference(pane, content.slot);
    const bool right = content.picture == StagePair::reference;
    pane.set_display(shown_display(right ? 0 : content.picture));
    pane.set_picture(right ? reference_ : pictures_[content.picture]);
    pane.set_labels(pane_label(content.picture));
    if (!poses_.empty())
        pane.camera().set_pose(poses_[std::min<std::size_t>(right ? 0 : content.picture, poses_.size() - 1)]);
    if (mode_ == Mode::wipe && held_ < 0 && count() >= 2) fill_wipe(pane);
}

void CompareView::fill_wipe(ImageView& pane) {
    pane.set_second(pictures_[1], shown_display(1));
    pane.set_labels(pane_label(0), pane_label(1));
    pane.set_wipe(wipe_);
}

void CompareView::request_differences() {
    const int pairs = mode_ == Mode::difference ? 1 : mode_ == Mode::stages ? count() - 1 : 0;
    const auto shared = [this](int i) { return i == StagePair::reference ? reference_ : pictures_[i]; };
    const auto request = [&](int slot) {
        const auto [a, b] = ends_of(slot);
        if (have_difference(stage(a), stage(b)))
            worker_->request(slot, {shared(a), shared(b), kind_, stage_name(a), stage_name(b)});
    };
    for (int i = 0; i < pairs && i + 1 < count(); ++i) request(i);
    if (has_pair()) request(pair_slot);
}

void CompareView::fill_difference(ImageView& pane, int slot) {
    const auto* result = worker_->result(slot);
    pane.set_second(nullptr);
    pane.set_labels(result ? result->picture->label : QString());
    const auto [a, b] = ends_of(slot);
    const bool both = stage(a).has_image() && stage(b).has_image();
    const bool possible = have_difference(stage(a), stage(b));
    if (!result || !possible) {
        pane.set_picture(make_note(
            possible ? tr("Computing the difference …")
            : both   ? tr("Sizes differ: %1 and %2 pixels.").arg(size_text(stage(a)), size_text(stage(b)))
                     : QString()));
        pane.set_labels({});
        return;
    }
    Display display = has_rows() ? stage_display() : result->automatic;
    if (difference_display_) {
        display = *difference_display_;
        display.hide_invalid = true;
        display.grey_zero = result->automatic.grey_zero;
    }
    if (slot == 0) shown_difference_ = display;
    pane.set_display(display);
    Picture picture = *result->picture;
    picture.stale = worker_->is_outdated(slot) || stage(a).stale || stage(b).stale;
    pane.set_picture(picture.stale ? std::make_shared<const Picture>(std::move(picture)) : result->picture);
    if (!poses_.empty()) pane.camera().set_pose(poses_[std::min<std::size_t>(a, poses_.size() - 1)]);
}

void CompareView::show_difference(int slot) {
    const auto shown = contents();
    const bool visible = std::any_of(shown.begin(), shown.end(), [&](const Content& content) {
        return content.difference && content.slot == slot;
    });
    if (!visible) return;
    refresh();
    emit difference_shown();
}

void CompareView::update_legends() {
    const auto shown = contents();
    for (std::size_t i = 0; i < shown.size(); ++i) {
        // In a row the last one speaks for those that are shown alike.
        bool last = true;
        for (std::size_t j = i + 1; j < shown.size(); ++j)
            last &=
                shown[i].difference != shown[j].difference || panes_[i]->display() != panes_[j]->display();
        const bool main_difference = mode_ == Mode::difference && shown[i].difference;
        panes_[i]->set_legend(main_difference || (legend_ && last));
    }
}

void CompareView::relink() {
    const std::size_t shown = contents().size();
    for (std::size_t i = 0; i < panes_.size(); ++i) {
        if (i < shown && shown > 1)
            link_->add(panes_[i]);
        else
            link_->remove(panes_[i]);
    }
    if (link_->is_linked() && shown > 1) link_->align_to(panes_[active_pane_]);
}

bool CompareView::is_right_of_wipe(int pane, QPoint pixel) const {
    return mode_ == Mode::wipe && held_ < 0 && panes_[pane]->state().pictures[1].picture &&
           pixel.x() + 0.5 >= wipe_ * panes_[pane]->image().width;
}

int CompareView::picture_of(int pane, QPoint pixel) const {
    const auto shown = contents();
    if (pane >= int(shown.size())) return 0;
    if (shown[pane].difference) return -1;
    if (is_right_of_wipe(pane, pixel)) return 1;
    if (shown[pane].picture == StagePair::reference) return count();
    return shown[pane].picture;
}

}  // namespace ir::widgets
