#include "app/gui/workspace.h"

#include <algorithm>
#include <utility>

#include "app/engine/camera_pose.h"
#include "app/gui/json_fields.h"
#include "app/gui/printed.h"
#include "app/gui/stage_chain.h"
#include "projects/names.h"
#include "widgets/compare/enlarger.h"

namespace ir::gui {

using widgets::CompareView;
using widgets::Display;
using widgets::ViewArea;
using widgets::ViewMode;
using widgets::ViewPane;
using widgets::ViewSource;
using widgets::ViewState;

namespace {

/// "Nave · Accessibility − Reference": what is shown of A, how, and what it is compared with.
QString title_of(const PictureSource& pictures, const widgets::ViewFields& fields, bool is_picture) {
    const auto name = [&](const ViewSource& source) {
        return QString::fromStdString(pictures.owner_name(source.owner));
    };
    const auto& shown = fields.state;
    const auto* a = pictures.find(fields.outputs_a, shown.a.output);
    if (!a) return {};
    const QString title = QStringLiteral("%1 · %2").arg(name(shown.a), a->label);
    if (!is_picture || !widgets::compares(shown.mode)) return title;
    const bool is_difference = shown.mode == ViewMode::difference;
    const QString how =
        is_difference ? widgets::difference_name(shown.difference) : widgets::mode_name(shown.mode);
    const auto* b = pictures.find(fields.outputs_b, shown.b.output);
    QStringList of_b;
    if (shown.b.owner != shown.a.owner) of_b << name(shown.b);
    if (b && (of_b.isEmpty() || b->label != a->label)) of_b << b->label;
    const QString other = of_b.join(QStringLiteral(" · "));
    if (widgets::takes_many(shown.mode) || other.isEmpty()) return QStringLiteral("%1 · %2").arg(title, how);
    if (is_difference && shown.difference == DifferenceKind::signed_)
        return QStringLiteral("%1 − %2").arg(title, other);
    return Workspace::tr("%1 · %2, B: %3").arg(title, how, other);
}

}  // namespace

Workspace::Workspace(Session& session, LivePictures& live, Renderer& renderer, ImageLoader& images,
                     KeptResults& kept, widgets::ImageView::Surface surface)
    : session_(session),
      live_(live),
      surface_(surface),
      area_(new ViewArea([this](int view) { return make_pane(view); })),
      views_(session, live, images, kept, *area_),
      alone_(views_),
      pictures_(session, views_),
      spaces_(live, renderer, views_) {
    connect(&views_, &ViewModel::shown_changed, this, &Workspace::update_view);
    connect(&session_, &Session::project_replaced, this,
            [this] { tools_.set_tool(widgets::ImageView::Tool::inspect); });
    connect(&views_, &ViewModel::linked_changed, this, &Workspace::on_linked);
    connect(&views_, &ViewModel::displays_changed, this, &Workspace::show_displays);
    connect(&views_, &ViewModel::explained_changed, this, [this](int view) {
        if (!pane(view)) return;
        pictures_.mark_explained(view, *pane(view));
        mark_said(view);
    });
}

ViewPane* Workspace::make_pane(int view) {
    auto* pane = new ViewPane(nullptr, surface_);
    pane->setObjectName(QStringLiteral("pane-%1").arg(view + 1));
    panes_[std::size_t(view)] = pane;
    tools_.add(pane->compare().panes());
    connect_pane(view, *pane);
    connect_compare(view, *pane);
    return pane;
}

void Workspace::connect_pane(int view, ViewPane& pane) {
    pane.header().set_thumbnails([this](const ViewSource& source) { return thumbnail(source); });
    connect(&pane.header(), &widgets::ViewHeader::state_chosen, this, [this, view](const ViewState& state) {
        area_->set_active(view);
        // Another mode is one of all pictures, also where one of them is alone.
        const bool is_mode = state.mode != views_.state(view).mode;
        views_.set_state(view, is_mode ? alone_.in_mode(view, state.mode) : state);
    });
    connect(&pane.header(), &widgets::ViewHeader::link_chosen, this,
            [this](bool linked) { views_.set_linked(linked); });
    connect(&pane, &ViewPane::buffer_dropped, this, [this, view](const QString& key) {
        const auto* chosen = session_.experiment();  // whose buffers are listed
        const auto outputs =
            chosen ? views_.pictures().outputs(chosen->id) : std::vector<widgets::OutputOption>();
        if (!views_.pictures().find(outputs, key.toStdString())) return;
        area_->set_active(view);
        views_.show_owner(chosen->id);
        views_.show_output(key.toStdString());
    });
    connect(&pane, &ViewPane::space_made, this,
            [this, view](widgets::SpacePane& space) { spaces_.add(view, space); });
    connect(&pane, &ViewPane::table_made, this,
            [this, view](widgets::BufferTable& table) { connect_table(view, table); });
    connect(&pane, &ViewPane::cursor_moved, this, [this, view, &pane](QPoint pixel) {
        if (view == area_->active())
            emit cursor_moved(pictures_.pointed_pixel_of_result(view, pane.compare(), pixel));
    });
    connect(&pane, &ViewPane::explain_wanted, this, [this, view, &pane](QPoint pixel) {
        area_->set_active(view);
        emit explain_wanted(pictures_.pointed_pixel_of_result(view, pane.compare(), pixel));
    });
}

void Workspace::connect_compare(int view, ViewPane& pane) {
    auto& compare = pane.compare();
    connect(&compare, &CompareView::linked_changed, this, [this](bool linked) { views_.set_linked(linked); });
    connect(&compare, &CompareView::swapped, this, [this, view] { swap(view); });
    connect(&compare, &CompareView::stage_pair_chosen, this, [this, view](widgets::StagePair pair) {
        auto state = views_.state(view);
        state.pair = pair;
        views_.set_state(view, state);
    });
    auto* enlarger = new widgets::Enlarger(compare, [this, view] { return alone_.is_shown(view); });
    connect(enlarger, &widgets::Enlarger::alone_wanted, this,
            [this, view](widgets::StagePair shown) { alone_.show(view, shown); });
    connect(enlarger, &widgets::Enlarger::back_wanted, this, [this, view] { alone_.show_all(view); });
    connect(&compare, &CompareView::activated, this, [this, view] { area_->set_active(view); });
    connect(&compare, &CompareView::menu_wanted, this, [this, view](QPoint position) {
        area_->set_active(view);
        emit menu_wanted(position);
    });
    connect(&compare, &CompareView::camera_moved, this,
            [this, view](const widgets::CameraPose& pose, int picture) {
                area_->set_active(view);
                const bool linked = views_.linked();
                const auto shown = views_.rules().places(views_.state(view));
                const auto place = linked ? std::size_t(0) : std::size_t(picture);
                if (place >= shown.size()) return;
                session_.camera().move(shown[place].owner, pose,
                                       linked ? views_.shown_experiments() : std::vector<std::string>());
            });
    connect(&compare, &CompareView::camera_gesture_finished, this,
            [this](int) { session_.camera().finish_move(); });
    connect(&compare, &CompareView::picked_changed, this, [this, view, &compare](QPoint pixel) {
        emit picked(pictures_.pointed_pixel_of_result(view, compare, pixel));
    });
    connect(&compare, &CompareView::difference_shown, this, [this, view, &pane] {
        pictures_.update_displays(view, pane.compare());
        update_shared(view);
        pane.update_summary();
        if (view == area_->active()) emit picture_shown();
    });
}

void Workspace::connect_table(int view, widgets::BufferTable& table) {
    connect(&table, &widgets::BufferTable::show_wanted, this, [this, view](qint64 element) {
        auto state = views_.state(view);
        state.as_table = false;
        views_.set_state(view, state);
        if (views_.rules().content_of(state) == ViewPane::Content::space)
            pane(view)->space().select_element(views_.pictures().key_of(state.a), element);
    });
    connect(&table, &widgets::BufferTable::save_wanted, this, [this, view] {
        area_->set_active(view);
        emit export_values_wanted();
    });
}

void Workspace::swap(int view) {
    auto state = views_.state(view);
    widgets::swap_first(state);
    views_.set_state(view, state);
}

void Workspace::on_linked(bool linked) {
    for (auto* pane : panes_)
        if (pane) pane->compare().set_linked(linked);
    pictures_.set_linked(linked);
    for (const int view : area_->open_views()) update_view(view);
}

void Workspace::show_displays() {
    for (const int view : area_->open_views())
        if (pane(view)) pictures_.update_displays(view, pane(view)->compare());
    emit picture_shown();
}

void Workspace::update_view(int view) {
    if (!pane(view)) return;
    update_header(view);
    const auto content = views_.rules().content_of(views_.state(view));
    if (content == ViewPane::Content::picture) {
        pictures_.update(view, *pane(view));
        mark_said(view);
        update_shared(view);
    } else {
        pane(view)->show_content(content);
        content == ViewPane::Content::space ? spaces_.update(view) : update_table(view);
    }
    update_camera(view);
    if (view == area_->active()) emit picture_shown();
}

/// In the other views.
void Workspace::update_shared(int view) {
    if (!pictures_.take_shared_change()) return;
    for (const int other : area_->open_views())
        if (other != view && pane(other)) pictures_.update_displays(other, pane(other)->compare());
}

void Workspace::mark_said(int view) {
    const auto& owner = views_.state(view).a.owner;
    const auto result = live_.result(owner);
    pictures_.mark_said(view, *pane(view), printed_text(printed_of(result.get(), views_.inspection(owner))));
}

void Workspace::update_header(int view) {
    auto& pictures = views_.pictures();
    const auto& shown = views_.state(view);
    widgets::ViewFields fields;
    fields.owners = pictures.owners();
    for (const auto& source : {shown.a, shown.b}) {  // a kept result that is gone has its name still
        const QString id = QString::fromStdString(source.owner);
        if (source.is_kept() && std::none_of(fields.owners.begin(), fields.owners.end(),
                                             [&](const auto& each) { return each.id == id; }))
            fields.owners.push_back({id, QString::fromStdString(pictures.owner_name(source.owner)), {}});
    }
    fields.outputs_a = pictures.outputs(shown.a.owner);
    fields.outputs_b = pictures.outputs(shown.b.owner);
    if (widgets::takes_many(shown.mode)) fields.candidates = views_.rules().candidates(shown);
    fields.state = shown;
    fields.linked = views_.linked();
    fields.has_stages = has_stages(session_, shown.a.owner);
    if (widgets::compares(shown.mode)) fields.warning = pictures.warning(shown.a, shown.b);
    if (shown.mode == ViewMode::stages) fields.warning = views_.rules().missing_stages(shown);
    pane(view)->header().set_fields(fields);
    const bool is_picture = views_.rules().content_of(shown) == ViewPane::Content::picture;
    area_->set_title(view, title_of(pictures, fields, is_picture));
}

void Workspace::update_table(int view) {
    auto& pictures = views_.pictures();
    auto& table = pane(view)->table();
    const auto& source = views_.state(view).a;
    const auto key = pictures.key_of(source);
    const auto result = live_.result(source.owner);
    const auto* resource = result ? find_resource(result->report, key) : nullptr;
    if (!result) return table.clear(pictures.why_nothing(source.owner));
    table.set_stale(pictures.is_stale(source.owner));
    const auto found = result->buffers.find(key);
    const bool is_shown =
        found != result->buffers.end() && table.model().buffer().bytes.get() == &found->second.bytes;
    const auto contents = live_.buffer(source.owner, key);
    if (is_shown && (contents || pictures.is_stale(source.owner))) return;
    if (!contents || contents->elements == 0) {
        const auto why = pictures.why_empty(source.owner, key);
        return table.clear(why.isEmpty() && resource ? pictures.why_not_by_then(source.owner, *resource)
                                                     : why);
    }
    // Shared with the result, not copied.
    widgets::BufferData data{contents->fields, contents->elements, {contents, &contents->bytes}};
    if (resource) data.categories = resource->categories;
    const auto moment = moment_text(result->after);
    table.set_buffer(QString::fromStdString(resource ? resource->label : key) +
                         (moment.isEmpty() ? QString() : QStringLiteral(" · ") + moment),
                     std::move(data));
}

void Workspace::update_camera(int view) {
    auto& compare = pane(view)->compare();
    const auto& a = views_.state(view).a.owner;
    const auto& b = views_.state(view).b.owner;
    const auto result = live_.result(a);
    const auto* chosen = session_.experiment();
    std::optional<widgets::CameraPose> pose;
    if (chosen && chosen->id == a) pose = session_.camera().pose();
    if (!pose && result) pose = engine::pose_of(result->camera);
    if (pose) compare.set_camera(*pose);
    const auto other = views_.linked() ? nullptr : live_.result(b);
    if (other && b != a) compare.set_camera(engine::pose_of(other->camera), 1);
}

std::string Workspace::display_key() const {
    return views_.rules().display_key(views_.active_state());
}

std::shared_ptr<const widgets::Picture> Workspace::display_picture() const {
    const bool difference = views_.active_state().mode == ViewMode::difference;
    if (difference && !active_pane().compare().compared().refusal().isEmpty()) return nullptr;
    return active_pane().picture_at(difference ? -1 : 0);
}

Display Workspace::display() const {
    const auto& compare = active_pane().compare();
    return views_.active_state().mode == ViewMode::difference ? compare.difference_display()
                                                              : compare.compared().shown_display(0);
}

bool Workspace::is_automatic() const {
    const auto is_chosen = [this](const std::string& key) {
        return views_.chosen_display(key, area_->active()) != nullptr;
    };
    const bool shares = views_.linked() && views_.rules().shows_light(views_.active_state());
    return !is_chosen(display_key()) && !(shares && is_chosen(DisplayMemory::light));
}

void Workspace::set_mode(ViewMode mode) {
    views_.set_active_state(alone_.in_mode(area_->active(), mode));
}

void Workspace::choose_display(const Display& chosen) {
    const auto before = display();
    views_.choose_display(chosen, &before);
}

void Workspace::open_comparison(const projects::Comparison& comparison) {
    auto state = views_.active_state();
    const auto owner = [this](const std::string& id) {
        return session_.experiment(id) ? id : std::string("image:") + id;
    };
    state.a = {owner(comparison.a), comparison.output};
    state.b = {owner(comparison.b), comparison.output};
    if (state.b.is_image()) state.b.output.clear();
    if (state.a.is_image()) state.a.output.clear();
    state.more.clear();
    state.as_table = false;
    const auto colon = comparison.mode.find(':');
    state.mode = widgets::mode_from_key(comparison.mode.substr(0, colon));
    if (colon != std::string::npos)
        state.difference = widgets::difference_from_key(comparison.mode.substr(colon + 1));
    if (comparison.mode == "flip-metric") {  // as projects called it before there were kinds of it
        state.mode = ViewMode::difference;
        state.difference = DifferenceKind::flip;
    }
    views_.set_active_state(state);
    if (!comparison.range) return;
    auto shown = display();
    shown.low = comparison.range->x;
    shown.high = comparison.range->y;
    views_.choose_display(shown);
}

projects::Comparison Workspace::as_comparison() {
    const auto& state = views_.active_state();
    const auto& pictures = views_.pictures();
    const auto id_of = [](const ViewSource& source) {
        return source.is_image() ? source.owner.substr(6) : source.owner;
    };
    projects::Comparison comparison;
    comparison.a = id_of(state.a);
    comparison.b = id_of(state.b);
    comparison.output = state.a.is_image() ? state.b.output : state.a.output;
    comparison.mode = widgets::to_key(state.mode);
    if (state.mode == ViewMode::difference) comparison.mode += ":" + widgets::to_key(state.difference);
    comparison.name =
        projects::comparison_name(pictures.owner_name(state.a.owner), pictures.owner_name(state.b.owner));
    if (!is_automatic()) comparison.range = glm::dvec2(display().low, display().high);
    return comparison;
}

bool Workspace::is_settled() const {
    const auto views = area_->open_views();
    return std::none_of(views.begin(), views.end(), [this](int view) {
        return spaces_.is_drawing(view) || (pane(view) && pane(view)->compare().is_computing());
    });
}

QString Workspace::missing(int view) const {
    const auto& shown = views_.state(view);
    const auto& pictures = views_.pictures();
    if (!session_.has_project()) return {};
    for (const auto& source : views_.rules().sources(shown))
        if (const auto why = pictures.why_unfinished(source.owner); !why.isEmpty()) return why;
    if (!pane(view)) return {};
    if (pane(view)->content() == ViewPane::Content::space)
        for (const auto& layer : shown.space.layers)
            if (const auto why = pictures.why_empty(shown.a.owner, layer.key);
                layer.visible && !why.isEmpty())
                return why;
    return pane(view)->missing();
}

void Workspace::save(projects::Json& memory) const {
    memory["views"] = {{"arrangement", area_->save().toBase64().toStdString()}, {"active", area_->active()}};
    if (auto* shown = pane(area_->active())) {
        const auto& transform = shown->compare().main_view().transform();
        memory["views"]["zoom"] = {{"fitted", transform.is_fitted()},
                                   {"zoom", transform.zoom()},
                                   {"x", transform.centre().x()},
                                   {"y", transform.centre().y()}};
    }
    views_.save(memory);
    tools_.save(memory);
}

void Workspace::load(const projects::Json& memory) {
    tools_.load(memory);
    spaces_.clear();
    alone_.clear();
    const int known = views_.load(memory);
    const auto& views = member_or_null(memory, "views");
    const auto arrangement = field_or(views, "arrangement", std::string());
    // Written by hand, a session file may name the views alone.
    using A = ViewArea::Arrangement;
    if (arrangement.empty())
        area_->arrange(known > 3 ? A::four : known == 3 ? A::three : known == 2 ? A::side_by_side : A::one);
    else
        area_->restore(QByteArray::fromBase64(QByteArray::fromStdString(arrangement)));
    area_->set_active(field_or(views, "active", 0));
    views_.finish_loading();
    const auto& zoom = member_or_null(views, "zoom");
    auto& compare = active_pane().compare();
    if (field_or(zoom, "fitted", true))
        compare.active_view().fit();
    else
        compare.active_view().look_at({field_or(zoom, "x", 0.0), field_or(zoom, "y", 0.0)},
                                      field_or(zoom, "zoom", 1.0));
    active_pane().setFocus();  // whatever gets the focus is the active view
}

}  // namespace ir::gui
