#include "widgets/space/space_scene.h"

#include <algorithm>

namespace ir::widgets {
namespace {

/// Whole numbers are names of things or counts; where something was measured it is the better colour.
bool is_measured(const Field& field) {
    return field.type == FieldType::f32;
}

/// Of a stack's layers at first: some ten of them can be seen through each other.
constexpr float stack_opacity = 0.3f;

const Field* best_value(const AvailableBuffer& buffer) {
    if (buffer.kind != OutputKind::sphere_values)
        for (const char* name : {"layer", "bounce", "depth", "distance"})
            if (const Field* field = find_field(buffer.fields, name)) return field;
    const auto first = [&](auto&& accepted) -> const Field* {
        for (const Field& field : buffer.fields)
            if (!is_geometry(buffer.kind, field) && accepted(field)) return &field;
        return nullptr;
    };
    const bool sphere = buffer.kind == OutputKind::sphere_values;
    if (const Field* field =
            first([&](const Field& f) { return is_measured(f) && (sphere || f.count == 1); }))
        return field;
    if (const Field* field = first([](const Field& f) { return f.count == 1; })) return field;
    return first([](const Field&) { return true; });
}

}  // namespace

bool is_spatial(OutputKind kind) {
    return kind == OutputKind::point_set || kind == OutputKind::line_set || kind == OutputKind::glyphs ||
           kind == OutputKind::sphere_values;
}

Space space_of(OutputKind kind, const std::vector<Field>& fields) {
    if (kind == OutputKind::sphere_values) return Space::sphere;
    return kind == OutputKind::point_set && find_field(fields, "place") ? Space::own : Space::scene;
}

bool is_geometry(OutputKind kind, const Field& field) {
    const auto one_of = [&](std::initializer_list<const char*> names) {
        return std::any_of(names.begin(), names.end(), [&](const char* name) { return field.name == name; });
    };
    switch (kind) {
        case OutputKind::point_set:
            return one_of({"position", "place", "normal"});
        case OutputKind::line_set:
            return one_of({"start", "end"});
        case OutputKind::glyphs:
            return one_of({"centre", "normal", "axis_u", "axis_v", "axis_w"});
        case OutputKind::sphere_values:
            return one_of({"centre", "colatitude", "longitude"});
        default:
            return false;
    }
}

SpaceLayer default_layer(const AvailableBuffer& buffer) {
    SpaceLayer layer;
    layer.key = buffer.key;
    layer.label = buffer.label.empty() ? buffer.key : buffer.label;
    layer.kind = buffer.kind;
    if (const Field* field = best_value(buffer)) {
        layer.colour_by = field->name;
        // Neighbouring layers and bounces must differ to be told apart.
        if (field->name == "layer" || field->name == "bounce") layer.colour_map = "turbo";
    } else if (buffer.kind == OutputKind::point_set && find_field(buffer.fields, "normal")) {
        layer.colour_by = SpaceLayer::facing;
        layer.colour_map = "coolwarm";
    }
    const bool is_stack = find_field(buffer.fields, "layer") && find_field(buffer.fields, "depth");
    if (buffer.kind == OutputKind::glyphs && is_stack) layer.opacity = stack_opacity;
    return layer;
}

void begin_with(SpaceScene& scene, std::vector<SpaceLayer> layers) {
    const auto is_translucent = [](const std::vector<SpaceLayer>& all) {
        return !all.empty() && all.front().opacity < 1;
    };
    if (is_translucent(layers) != is_translucent(scene.layers)) scene.show_scene = !is_translucent(layers);
    scene.layers = std::move(layers);
}

bool shows_sphere(const SpaceScene& scene) {
    return std::any_of(scene.layers.begin(), scene.layers.end(), [](const SpaceLayer& layer) {
        return layer.visible && layer.kind == OutputKind::sphere_values;
    });
}

std::vector<int> scene_indices(const std::vector<LayerInfo>& drawn, const std::vector<SpaceLayer>& layers) {
    std::vector<int> indices;
    std::vector<bool> taken(layers.size(), false);
    for (const LayerInfo& info : drawn) {
        indices.push_back(-1);
        for (std::size_t i = 0; i < layers.size(); ++i) {
            if (taken[i] || !layers[i].visible || layers[i].key != info.key) continue;
            taken[i] = true;
            indices.back() = int(i);
            break;
        }
    }
    return indices;
}

SpaceElement element_near(const SpacePicture& picture, const std::vector<int>& indices, QPoint pixel,
                          int reach) {
    const Image& image = picture.colour;
    const QRect around = QRect(pixel - QPoint(reach, reach), pixel + QPoint(reach, reach)) &
                         QRect(0, 0, image.width, image.height);
    int best = reach * reach + 1;
    SpaceElement found;
    for (int y = around.top(); y <= around.bottom(); ++y)
        for (int x = around.left(); x <= around.right(); ++x) {
            const QPoint away = QPoint(x, y) - pixel;
            const int distance = QPoint::dotProduct(away, away);
            const auto at = std::size_t(y) * image.width + x;
            if (distance >= best || at >= picture.layer.size() || at >= picture.element.size()) continue;
            const int drawn = picture.layer[at];
            if (drawn < 0 || std::size_t(drawn) >= indices.size() || indices[std::size_t(drawn)] < 0)
                continue;
            best = distance;
            found = {indices[std::size_t(drawn)], picture.element[at]};
        }
    return found;
}

std::optional<SpaceBox> bounds_of(const std::vector<LayerInfo>& layers) {
    std::optional<SpaceBox> box;
    for (const LayerInfo& info : layers) {
        if (!info.bounds || info.elements == 0) continue;
        if (!box) box = info.bounds;
        box->low = glm::min(box->low, info.bounds->low);
        box->high = glm::max(box->high, info.bounds->high);
    }
    return box;
}

}  // namespace ir::widgets
