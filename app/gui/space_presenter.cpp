#include "app/gui/space_presenter.h"

#include <algorithm>

#include "app/engine/camera_pose.h"

namespace ir::gui {

using widgets::SpacePane;
using widgets::SpaceScene;
using widgets::SpaceView;

namespace {

std::string tag_of(int view) {
    return "view-" + std::to_string(view + 1);
}

passes::viewers::Layer layer_of(const widgets::SpaceLayer& layer) {
    passes::viewers::Layer result;
    result.key = layer.key;
    result.colour_by = layer.colour_by;
    result.component = layer.component;
    result.low = layer.low;
    result.high = layer.high;
    result.colour_map = layer.colour_map;
    result.size_px = layer.size_px;
    static_assert(widgets::SpaceLayer::min_opacity == passes::viewers::Layer::min_opacity);
    result.opacity = layer.opacity;
    for (const auto& filter : layer.filters)
        result.filters.push_back({filter.field, filter.low, filter.high});
    result.selected = layer.selected;
    return result;
}

widgets::LayerInfo info_of(const passes::viewers::DrawnLayer& layer) {
    widgets::LayerInfo info;
    info.key = layer.key;
    info.note = layer.note;
    info.fields = layer.fields;
    info.elements = layer.elements;
    info.stride = layer.stride;
    info.passing = layer.passing;
    info.low = layer.low;
    info.high = layer.high;
    info.min = layer.min;
    info.max = layer.max;
    info.categories = layer.categories;
    return info;
}

widgets::SpacePicture picture_of(const passes::viewers::Picture3D& drawn) {
    widgets::SpacePicture picture;
    picture.colour = drawn.colour;
    picture.layer = drawn.layer;
    picture.element = drawn.element;
    for (const auto& layer : drawn.layers) picture.layers.push_back(info_of(layer));
    picture.camera = engine::pose_of(drawn.camera);
    return picture;
}

}  // namespace

SpacePresenter::SpacePresenter(LivePictures& live, Renderer& renderer, ViewModel& views)
    : live_(live), renderer_(renderer), views_(views) {
    connect(&renderer_, &Renderer::scene_view_arrived, this, &SpacePresenter::on_picture);
}

void SpacePresenter::add(int view, SpacePane& space) {
    spaces_[std::size_t(view)] = &space;
    connect(&space.view(), &SpaceView::view_wanted, this,
            [this, view](const SpaceScene& scene, QSize size, int oversampling) {
                request(view, scene, size, oversampling);
            });
    connect(&space, &SpacePane::scene_changed, this, [this, view](const SpaceScene& scene) {
        auto state = views_.state(view);
        state.space = scene;
        for (auto& layer : state.space.layers) layer.selected = -1;
        views_.set_state(view, state);
    });
    connect(&space.panel(), &widgets::LayerPanel::item_chosen, this,
            [this, view](const QString& selector, int item) {
                const std::string owner = views_.state(view).a.owner;  // the view may change meanwhile
                auto now = views_.inspection(owner);
                now.chosen[selector.toStdString()] = item;
                views_.set_inspection(owner, now);
            });
    connect(&space.view(), &SpaceView::element_hovered, this,
            [this, view, &space](int layer, qint64 element) {
                space.view().set_hover_values(hover_text(view, layer, element));
            });
    connect(&space.view(), &SpaceView::element_clicked, this,
            [this, view](int layer, qint64 element) { choose_items(view, layer, element); });
}

/// Of a layer's elements, where its buffer was sent.
std::optional<widgets::BufferReader> SpacePresenter::values_of(int view, int layer) const {
    const auto& layers = views_.state(view).space.layers;
    if (layer < 0 || layer >= int(layers.size())) return {};
    const auto buffer = live_.buffer(views_.state(view).a.owner, layers[std::size_t(layer)].key);
    if (!buffer) return {};
    return widgets::BufferReader({buffer->fields, buffer->elements, {buffer, &buffer->bytes}});
}

QString SpacePresenter::hover_text(int view, int layer, qint64 element) const {
    const auto values = values_of(view, layer);
    if (!values || element < 0 || element >= qint64(values->elements())) return {};
    const auto& key = views_.state(view).space.layers[std::size_t(layer)].key;
    const auto* resource = find_resource(live_.result(views_.state(view).a.owner)->report, key);
    QStringList lines;
    for (std::size_t i = 0; i < values->scalars().size(); ++i) {
        const auto& name = values->scalars()[i].name;
        const auto number = values->value(std::uint64_t(element), i);
        const auto label =
            resource ? category_label(categories_of(resource->categories, name), number) : std::string();
        lines << QString::fromStdString(name + " " + values->text(std::uint64_t(element), i) +
                                        (label.empty() ? "" : ": " + label));
    }
    return lines.join(QLatin1Char('\n'));
}

/// A click on a direction of the sphere, on a photon, chooses the item that it stands for.
void SpacePresenter::choose_items(int view, int layer, qint64 element) {
    const auto values = values_of(view, layer);
    if (!values || element < 0 || element >= qint64(values->elements())) return;
    const std::string owner = views_.state(view).a.owner;  // the view may change meanwhile
    auto now = views_.inspection(owner);
    for (const auto& selector : views_.selectors(owner))
        for (std::size_t i = 0; i < values->scalars().size(); ++i)
            if (const auto& field = values->scalars()[i];
                field.name == selector.key && field.type != FieldType::f32)
                now.chosen[selector.key] = int(values->value(std::uint64_t(element), i));
    views_.set_inspection(owner, now);
}

void SpacePresenter::update(int view) {
    auto& space = *spaces_[std::size_t(view)];
    const auto& owner = views_.state(view).a.owner;
    space.set_available(views_.rules().spatial_buffers(owner));
    space.set_selectors(views_.selectors(owner));
    auto wanted = views_.state(view).space;
    for (auto& layer : wanted.layers)  // what is marked is the view's own
        for (const auto& present : space.view().scene().layers)
            if (present.key == layer.key) layer.selected = present.selected;
    if (space.view().scene() != wanted) space.set_scene(wanted);
    auto& drawing = drawings_[std::size_t(view)];
    if (drawing.owner != owner) {
        drawing = {};
        drawing.owner = owner;
        space.view().clear(tr("Drawing …"));
    }
    const auto result = live_.result(owner);
    space.view().set_stale(views_.pictures().is_stale(owner));
    // What another method has drawn must not stand under this one's name.
    const bool is_past = live_.past().is_elsewhere();  // its buffers are gone
    if (!result || is_past) {
        drawing = {};
        drawing.owner = owner;
        return space.view().clear(is_past ? tr("Views in space show the newest frame alone (Alt+N).")
                                          : views_.pictures().why_nothing(owner));
    }
    if (drawing.result.lock() == result) return;
    drawing.result = result;
    space.view().refresh();
}

void SpacePresenter::request(int view, const SpaceScene& scene, QSize device_px, int oversampling) {
    const auto& owner = views_.state(view).a.owner;
    const auto result = live_.result(owner);
    if (!result || live_.past().is_elsewhere() || device_px.isEmpty()) return;
    engine::SceneViewRequest request;
    request.tag = tag_of(view);
    request.execution = owner;
    request.view.after = result->after;  // another step is drawn when its result is there
    request.view.width = device_px.width();
    request.view.height = device_px.height();
    request.view.oversampling = oversampling;
    if (scene.camera) request.view.camera = engine::camera_of(*scene.camera);
    request.view.show_scene = scene.show_scene;
    request.view.show_centres = scene.show_centres;
    for (const auto& layer : scene.layers)
        if (layer.visible) request.view.layers.push_back(layer_of(layer));
    auto& drawing = drawings_[std::size_t(view)];
    drawing.newest_serial = renderer_.draw(std::move(request));
    if (drawing.first_serial == 0) drawing.first_serial = drawing.newest_serial;
}

void SpacePresenter::on_picture(std::shared_ptr<const engine::SceneViewResult> result) {
    for (int view = 0; view < widgets::ViewArea::max_views; ++view) {
        auto* space = spaces_[std::size_t(view)];
        if (tag_of(view) != result->tag || !space) continue;
        auto& drawing = drawings_[std::size_t(view)];
        if (drawing.first_serial == 0 || result->serial < drawing.first_serial)
            return;  // of what the view showed before
        drawing.answered_serial = std::max(drawing.answered_serial, result->serial);
        if (!result->error.empty()) return space->view().set_note(QString::fromStdString(result->error));
        auto picture = picture_of(result->picture);
        picture.moment = moment_text(result->after);
        const auto& owner = views_.state(view).a.owner;
        for (auto& layer : picture.layers)  // the viewer knows no reasons
            if (const auto why = views_.pictures().why_empty(owner, layer.key);
                layer.elements == 0 && !why.isEmpty())
                layer.note = why.toStdString();
        space->view().set_picture(std::move(picture));
    }
}

}  // namespace ir::gui
