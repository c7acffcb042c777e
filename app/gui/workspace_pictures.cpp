#include <algorithm>

#include "app/gui/workspace.h"
#include "renderers/image/channels.h"

namespace ir::gui {

using widgets::Display;
using widgets::ViewMode;
using widgets::ViewSource;

namespace {

constexpr const char* difference_prefix = "difference:";

}  // namespace

/// What a foreign image means nobody says: beside a picture of ours of as many channels, the same, and it is
/// shown alike. Everything else means what it says itself.
ViewSource Workspace::meaning_of(const widgets::ViewState& state, const ViewSource& source) {
    const auto foreign = source.is_image() ? pictures_.picture(source) : nullptr;
    if (!foreign || !foreign->has_image()) return source;
    const auto values = [](const widgets::Picture& picture) {
        return value_channels(picture.semantic, picture.image->channels);
    };
    for (const auto& other : sources(state)) {
        const auto ours = other.is_image() ? nullptr : pictures_.picture(other);
        if (ours && ours->has_image() && values(*ours) == values(*foreign)) return other;
    }
    return source;
}

std::shared_ptr<const widgets::Picture> Workspace::unless_equal(
    const std::shared_ptr<const widgets::Picture>& shown,
    const std::shared_ptr<const widgets::Picture>& picture) {
    return shown && picture && *shown == *picture ? shown : picture;
}

void Workspace::update_pictures(int view) {
    std::vector<std::shared_ptr<const widgets::Picture>> shown;
    const auto wanted = sources(state(view));
    for (const auto& source : wanted) shown.push_back(pictures_.picture(source));
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const auto meaning = meaning_of(state(view), wanted[i]);
        if (meaning == wanted[i]) continue;
        const auto ours = pictures_.picture(meaning);
        auto alike = *shown[i];
        alike.semantic = ours->semantic;
        alike.unit = ours->unit;
        alike.colour_map = ours->colour_map;
        shown[i] = std::make_shared<const widgets::Picture>(std::move(alike));
    }
    if (state(view).difference == DifferenceKind::significant)
        pane(view)->compare().set_noise_hint(pictures_.variance_hint());
    if (compares_reference(state(view))) shown.pop_back();  // it stands beside the row
    name_stages(view, shown);
    const auto& before = pane(view)->compare().pictures();
    for (std::size_t i = 0; i < std::min(before.size(), shown.size()); ++i)
        shown[i] = unless_equal(before[i], shown[i]);
    update_reference(view);
    pane(view)->show_pictures(state(view), std::move(shown));
    update_displays(view);
    link_views();
}

std::string Workspace::display_key_of(const ViewSource& source) const {
    return source.is_image() ? source.owner + "/" + source.output : pictures_.key_of(source);
}

Display Workspace::display_of(const ViewSource& source, int view) {
    const int owner = linked_ ? DisplayMemory::shared : view;
    const auto* chosen = displays_.chosen(display_key_of(source), owner);
    return chosen ? *chosen : pictures_.automatic_display(source);
}

void Workspace::update_displays(int view) {
    auto& compare = pane(view)->compare();
    const auto& shown = state(view);
    std::vector<Display> displays;
    for (const auto& source : sources(shown)) displays.push_back(display_of(meaning_of(shown, source), view));
    compare.set_displays(std::move(displays));
    const auto* chosen = displays_.chosen(difference_key_of(shown), linked_ ? DisplayMemory::shared : view);
    compare.set_difference_display(chosen ? std::optional(*chosen) : std::nullopt);
}

/// All picture views of all panes are one set: those of equal size move together.
void Workspace::link_views() {
    for (const int view : area_->open_views())
        if (pane(view))
            for (auto* each : pane(view)->compare().views()) link_.add(each);
}

std::string Workspace::difference_key_of(const widgets::ViewState& state) {
    return difference_prefix + widgets::to_key(state.difference) + ":" +
           display_key_of(meaning_of(state, state.a));
}

std::string Workspace::display_key() {
    const auto& state = active_state();
    return state.mode == ViewMode::difference ? difference_key_of(state)
                                              : display_key_of(meaning_of(state, state.a));
}

std::shared_ptr<const widgets::Picture> Workspace::display_picture() const {
    if (!active_pane().compare().refusal().isEmpty() && active_state().mode == ViewMode::difference)
        return nullptr;
    return active_pane().picture_at(active_state().mode == ViewMode::difference ? -1 : 0);
}

Display Workspace::display() const {
    const auto& compare = active_pane().compare();
    return active_state().mode == ViewMode::difference ? compare.difference_display()
                                                       : compare.shown_display(0);
}

bool Workspace::is_automatic() {
    return !displays_.chosen(display_key(), linked_ ? DisplayMemory::shared : area_->active());
}

void Workspace::choose_display(const Display& display) {
    displays_.choose(display_key(), display, linked_ ? DisplayMemory::shared : area_->active());
    for (const int view : area_->open_views())
        if (pane(view)) update_displays(view);
    emit picture_shown();
}

void Workspace::choose_automatic() {
    displays_.forget(display_key(), linked_ ? DisplayMemory::shared : area_->active());
    for (const int view : area_->open_views())
        if (pane(view)) update_displays(view);
    emit picture_shown();
}

void Workspace::connect_table(int view, widgets::BufferTable& table) {
    connect(&table, &widgets::BufferTable::show_wanted, this, [this, view](qint64 element) {
        auto state = states_[std::size_t(view)];
        state.as_table = false;
        set_state(view, state);
        if (content_of(state) == widgets::ViewPane::Content::space)
            panes_[std::size_t(view)]->space().select_element(pictures_.key_of(state.a), element);
    });
    connect(&table, &widgets::BufferTable::save_wanted, this, [this, view] {
        area_->set_active(view);
        emit export_values_wanted();
    });
}

void Workspace::update_table(int view) {
    auto& pane = *panes_[std::size_t(view)];
    pane.show_content(widgets::ViewPane::Content::table);
    const auto& source = state(view).a;
    const auto key = pictures_.key_of(source);
    const auto result = live_.result(source.owner);
    const auto* resource = result ? find_resource(result->report, key) : nullptr;
    if (!result) return pane.table().clear(pictures_.why_nothing(source.owner));
    const auto found = result->buffers.find(key);
    if (found == result->buffers.end() || found->second.elements == 0)
        return pane.table().clear(pictures_.why_empty(source.owner, key));
    // Shared with the result, not copied.
    widgets::BufferData data{found->second.fields, found->second.elements, {result, &found->second.bytes}};
    if (data.bytes == pane.table().model().buffer().bytes) return;
    pane.table().set_buffer(QString::fromStdString(resource ? resource->label : key), std::move(data));
}

}  // namespace ir::gui
