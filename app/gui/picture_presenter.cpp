#include "app/gui/picture_presenter.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "app/gui/pixel_places.h"
#include "app/gui/stage_chain.h"

namespace ir::gui {

using widgets::CompareView;
using widgets::Picture;
using widgets::ViewMode;
using widgets::ViewPane;
using widgets::ViewSource;

namespace {

/// The picture that is shown already where the other one says the same: it is not prepared, drawn and
/// compared anew.
std::shared_ptr<const Picture> unless_equal(const std::shared_ptr<const Picture>& shown,
                                            const std::shared_ptr<const Picture>& picture) {
    return shown && picture && *shown == *picture ? shown : picture;
}

/// The picture with a change.
template <class Change>
std::shared_ptr<const Picture> changed(const Picture& picture, Change change) {
    auto copy = std::make_shared<Picture>(picture);
    change(*copy);
    return copy;
}

/// Of pictures of one owner what they show, and of several owners the names of these alone where all show the
/// same of theirs: there is little room under pictures in a row.
void leave_out_common(std::vector<std::shared_ptr<const Picture>>& pictures, const QString& owner) {
    if (pictures.size() < 2) return;
    const QString begin = owner + QStringLiteral(" · ");
    if (!owner.isEmpty() &&
        std::ranges::all_of(pictures, [&](const auto& each) { return each->label.startsWith(begin); })) {
        for (auto& each : pictures)
            each = changed(*each, [&](Picture& named) { named.label.remove(0, begin.size()); });
        return;
    }
    const QString output =
        pictures.front()->label.mid(std::max(0, int(pictures.front()->label.lastIndexOf(" · "))));
    std::set<QString> names;
    for (const auto& each : pictures)
        if (each->label.endsWith(output)) names.insert(each->label.chopped(output.size()));
    if (names.size() != pictures.size() || names.count({})) return;
    for (auto& each : pictures)
        each = changed(*each, [&](Picture& named) { named.label.chop(output.size()); });
}

}  // namespace

PicturePresenter::PicturePtr PicturePresenter::with_meaning(int view, const ViewSource& source) const {
    auto& pictures = views_.pictures();
    const auto picture = pictures.picture(source);
    const auto meaning = views_.rules().meaning_of(views_.state(view), source);
    if (meaning == source) return picture;
    return changed(*picture, [ours = pictures.picture(meaning)](Picture& alike) {
        alike.semantic = ours->semantic;
        alike.unit = ours->unit;
        alike.colour_map = ours->colour_map;
        alike.categories = ours->categories;
    });
}

void PicturePresenter::update(int view, ViewPane& pane) {
    const auto& state = views_.state(view);
    auto& compare = pane.compare();
    std::vector<PicturePtr> shown;
    for (const auto& source : views_.rules().pictures(state)) shown.push_back(with_meaning(view, source));
    if (state.difference == DifferenceKind::significant)
        compare.set_noise_hint(views_.pictures().variance_hint());
    name_stages(view, shown);
    const auto& before = compare.compared().pictures;
    for (std::size_t i = 0; i < std::min(before.size(), shown.size()); ++i)
        shown[i] = unless_equal(before[i], shown[i]);
    update_references(view, compare);
    pane.show_pictures(state, std::move(shown));
    update_displays(view, compare);
    for (auto* each : compare.views()) link_.add(each);
}

/// Pictures of a chain are called as the method calls its stages, others as briefly as they can be.
void PicturePresenter::name_stages(int view, std::vector<PicturePtr>& pictures) const {
    const auto& shown = views_.state(view);
    if (shown.mode != ViewMode::stages) return;
    if (!shown.chain) {
        const auto sources = views_.rules().pictures(shown);
        const bool is_one =
            std::ranges::all_of(sources, [&](const ViewSource& each) { return each.owner == shown.a.owner; });
        const auto owner = is_one ? views_.pictures().owner_name(shown.a.owner) : std::string();
        return leave_out_common(pictures, QString::fromStdString(owner));
    }
    const auto chain = stages_of(session_, shown.a.owner);
    for (std::size_t i = 0; i < std::min(chain.size(), pictures.size()); ++i)
        pictures[i] = changed(*pictures[i], [&](Picture& named) { named.label = chain[i].label; });
}

void PicturePresenter::update_references(int view, CompareView& compare) {
    const auto& state = views_.state(view);
    const auto& rules = views_.rules();
    const auto is_none = [](const ViewSource& source) { return source.owner.empty(); };
    const auto known = rules.references(state);
    const auto shown = rules.pictures(state);
    const auto& before = compare.compared().references;
    std::vector<PicturePtr> references;
    for (const auto& source : rules.compared_references(state)) {
        const auto i = references.size();
        references.emplace_back();
        if (is_none(source)) continue;
        const auto picture = views_.pictures().picture(source);
        const auto named = changed(*picture, [&](Picture& right) {
            right.label = QString::fromStdString(views_.pictures().owner_name(source.owner));
            // Of the experiment's size it is compared like its own pictures, with stages of smaller sizes,
            // too.
            if (right.size() == rules.main_size(shown[i].owner)) right.origin = shown[i].owner;
        });
        references.back() = i < before.size() ? unless_equal(before[i], named) : named;
    }
    compare.set_references(!std::all_of(known.begin(), known.end(), is_none), std::move(references));
}

widgets::Display PicturePresenter::display_of(const ViewSource& source, int view) const {
    const auto* chosen = views_.chosen_display(views_.rules().display_key(source), view);
    if (chosen && !views_.linked()) return *chosen;
    const auto display = chosen ? *chosen : views_.pictures().automatic_display(source);
    if (display.mode != widgets::Display::Mode::colour || !views_.rules().is_light(source)) return display;
    if (const auto* light = views_.linked() ? views_.chosen_display(DisplayMemory::light, view) : nullptr)
        return exposed_like(display, *light);
    widgets::Display automatic;
    automatic.exposure = shared_exposure(view, views_.pictures().picture(source)->semantic);
    return exposed_like(display, automatic);
}

/// That of the first picture of this meaning in the view, and in linked views of all: else brightness could
/// not be compared.
double PicturePresenter::shared_exposure(int view, Semantic semantic) const {
    for (const int each : views_.linked() ? views_.open_views() : std::vector{view})
        for (const auto& source : views_.rules().sources(views_.state(each))) {
            const auto picture = views_.pictures().picture(source);
            if (picture->has_image() && picture->semantic == semantic)
                return views_.pictures().automatic_display(source).exposure;
        }
    return 0;
}

bool PicturePresenter::take_shared_change() {
    Shared now;
    if (views_.linked()) {
        for (const auto semantic : {Semantic::radiance, Semantic::irradiance})
            now.exposures[semantic] = shared_exposure(0, semantic);
        for (const int view : views_.open_views())
            if (const auto own = own_difference(view)) now.ranges[view] = {own->low, own->high};
    }
    return std::exchange(shared_, now) != now;
}

/// How a view's differences are shown where neither a person nor another view has a say; absent: it has none.
std::optional<widgets::Display> PicturePresenter::own_difference(int view) const {
    const auto* compare = compare_views_[std::size_t(view)];
    if (!compare || views_.rules().content_of(views_.state(view)) != ViewPane::Content::picture) return {};
    return compare->own_difference_display();
}

/// Linked differences of one kind and meaning have one range, so that equal colours mean equal values. Those
/// of rows, which no outlier widens, are apart from those that stand alone.
std::optional<widgets::Display> PicturePresenter::difference_display(int view) const {
    const auto* chosen = views_.chosen_display(views_.rules().difference_key(views_.state(view)), view);
    if (chosen) return *chosen;
    const auto own = own_difference(view);
    if (!own || !views_.linked()) return {};
    auto common = *own;
    const auto meaning = [&](int each) {
        const auto& compared = compare_views_[std::size_t(each)]->compared();
        return std::tuple(compared.kind, compared.mode, compared.picture(0)->semantic,
                          compared.picture(0)->unit);
    };
    for (const int each : views_.open_views()) {
        const auto other = own_difference(each);
        if (!other || meaning(each) != meaning(view)) continue;
        common.low = std::min(common.low, other->low);
        common.high = std::max(common.high, other->high);
    }
    return common == *own ? std::nullopt : std::optional(common);
}

void PicturePresenter::update_displays(int view, CompareView& compare) {
    const auto& rules = views_.rules();
    const auto& shown = views_.state(view);
    std::vector<widgets::Display> displays;
    for (const auto& source : rules.pictures(shown)) {
        const auto picture = views_.pictures().picture(source);
        displays.push_back(picture->is_preview ? widgets::Display()
                                               : display_of(rules.meaning_of(shown, source), view));
    }
    compare_views_[std::size_t(view)] = &compare;
    compare.set_displays(std::move(displays));
    compare.set_difference_display(difference_display(view));
}

QPoint PicturePresenter::pixel_of_result(int view, const Picture* picture, QPoint pixel) const {
    const QSize main = views_.rules().main_size(views_.state(view).a.owner);
    if (pixel.x() < 0 || !picture || !picture->has_image()) return {-1, -1};
    if (main.isEmpty()) return pixel;
    const auto place = widgets::locate(*picture, pixel);
    QSize size = picture->size();
    for (const auto& tile : picture->atlas.tiles)
        if (tile.level == place.level && tile.layer == place.layer) size = {tile.width, tile.height};
    return pixel_of_main(main, size, place.pixel);
}

QPoint PicturePresenter::pointed_pixel_of_result(int view, const CompareView& compare, QPoint pixel) const {
    return pixel_of_result(view, compare.pointed_picture().get(), pixel);
}

void PicturePresenter::mark_explained(int view, ViewPane& pane) {
    const auto& owner = views_.state(view).a.owner;
    const auto& now = views_.inspection(owner);
    if (!now.has_pixel()) return;
    const QPoint explained(now.x, now.y);
    auto& compare = pane.compare();
    for (const auto* each : compare.views())
        if (pixel_of_result(view, each->picture().get(), each->state().marks.picked) == explained) return;
    const auto [pixel, size] = shown_pixel(view, pane, explained);
    compare.panes().set_picked(pixel, size);
}

void PicturePresenter::mark_said(int view, ViewPane& pane, const QString& text) {
    const auto& now = views_.inspection(views_.state(view).a.owner);
    const auto pixel = shown_pixel(view, pane, {now.x, now.y}).first;
    pane.compare().main_view().set_mark(&widgets::Marks::said,
                                        {text.isEmpty() ? QPoint(-1, -1) : pixel, text});
}

std::pair<QPoint, QSize> PicturePresenter::shown_pixel(int view, ViewPane& pane, QPoint pixel) const {
    const auto picture = pane.picture_at(0);
    const QSize main = views_.rules().main_size(views_.state(view).a.owner);
    if (!picture || !picture->has_image() || picture->atlas.tiles.empty() || main.isEmpty())
        return {pixel, main};
    const auto& first = picture->atlas.tiles.front();
    const QPoint mark = pixel_of_level(main, {first.width, first.height}, pixel);
    return {mark.x() < 0 ? mark : mark + QPoint(first.x, first.y), picture->size()};
}

}  // namespace ir::gui
