#include "app/gui/view_memory.h"

#include <algorithm>
#include <cmath>

#include "app/gui/json_fields.h"
#include "projects/document_fields.h"
#include "renderers/core/limits.h"

namespace ir::gui {
namespace {

using projects::Json;
using widgets::SpaceLayer;
using widgets::ViewSource;

constexpr std::size_t max_items = 64;  ///< of a list in a session file

Json to_json(const ViewSource& source) {
    return {
        {"owner", source.owner}, {"output", source.output}, {"level", source.level}, {"layer", source.layer}};
}

ViewSource source_from_json(const Json& json) {
    ViewSource source;
    source.owner = field_or(json, "owner", source.owner);
    source.output = field_or(json, "output", source.output);
    source.level = std::max(ViewSource::all, field_or(json, "level", 0));
    source.layer = std::max(ViewSource::all, field_or(json, "layer", 0));
    return source;
}

widgets::StagePair pair_from_json(const Json& json) {
    if (!json.is_array() || json.size() != 2 || !json[0].is_number_integer() || !json[1].is_number_integer())
        return {};
    const auto place = [&](std::size_t i, int min) {
        return int(std::clamp<std::int64_t>(json[i].get<std::int64_t>(), min, max_items));
    };
    return {place(0, widgets::StagePair::none), place(1, widgets::StagePair::reference)};
}

constexpr OutputKind spatial_kinds[] = {OutputKind::point_set, OutputKind::line_set, OutputKind::glyphs,
                                        OutputKind::sphere_values};

Json to_json(const SpaceLayer& layer) {
    Json json = {{"key", layer.key},
                 {"label", layer.label},
                 {"kind", to_string(layer.kind)},
                 {"colour_by", layer.colour_by},
                 {"component", layer.component},
                 {"colour_map", layer.colour_map},
                 {"size_px", layer.size_px},
                 {"opacity", layer.opacity},
                 {"visible", layer.visible}};
    if (layer.low) json["low"] = *layer.low;
    if (layer.high) json["high"] = *layer.high;
    for (const auto& filter : layer.filters)
        json["filters"].push_back({{"field", filter.field}, {"low", filter.low}, {"high", filter.high}});
    return json;
}

SpaceLayer layer_from_json(const Json& json) {
    SpaceLayer layer;
    layer.key = field_or(json, "key", layer.key);
    layer.label = field_or(json, "label", layer.label);
    const auto kind = field_or(json, "kind", std::string());
    for (const auto each : spatial_kinds)
        if (to_string(each) == kind) layer.kind = each;
    layer.colour_by = field_or(json, "colour_by", layer.colour_by);
    layer.component = std::clamp(field_or(json, "component", 0), 0, 15);
    layer.colour_map = field_or(json, "colour_map", layer.colour_map);
    layer.size_px = std::clamp(field_or(json, "size_px", layer.size_px), 1.0f, 64.0f);
    layer.opacity = std::clamp(field_or(json, "opacity", layer.opacity), SpaceLayer::min_opacity, 1.0f);
    layer.visible = field_or(json, "visible", true);
    if (member_or_null(json, "low").is_number()) layer.low = json["low"].get<double>();
    if (member_or_null(json, "high").is_number()) layer.high = json["high"].get<double>();
    for (const auto& filter : member_or_null(json, "filters"))
        if (layer.filters.size() < max_items)
            layer.filters.push_back({field_or(filter, "field", std::string()), field_or(filter, "low", 0.0),
                                     field_or(filter, "high", 0.0)});
    return layer;
}

std::optional<glm::dvec3> vector_from_json(const Json& json) {
    if (!json.is_array() || json.size() != 3) return {};
    glm::dvec3 v;
    for (int i = 0; i < 3; ++i) {
        if (!json[std::size_t(i)].is_number()) return {};
        v[i] = json[std::size_t(i)].get<double>();
        if (!std::isfinite(v[i])) return {};
    }
    return v;
}

Json to_json(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

}  // namespace

Json to_json(const Inspection& inspection) {
    Json json = {{"x", inspection.x}, {"y", inspection.y}, {"chosen", Json::object()}};
    for (const auto& [selector, item] : inspection.chosen) json["chosen"][selector] = item;
    return json;
}

Inspection inspection_from_json(const Json& json) {
    Inspection inspection;
    inspection.x = std::clamp(field_or(json, "x", -1), -1, max_image_side - 1);
    inspection.y = std::clamp(field_or(json, "y", -1), -1, max_image_side - 1);
    const auto& chosen = member_or_null(json, "chosen");
    if (!chosen.is_object()) return inspection;
    for (const auto& [selector, item] : chosen.items())
        if (item.is_number_integer() && inspection.chosen.size() < max_items)
            inspection.chosen[selector] = std::clamp(item.get<int>(), Inspection::all, 1 << 24);
    return inspection;
}

namespace {

/// Empty where odd.
QSize size_from_json(const Json& of) {
    if (!of.is_array() || of.size() != 2 || !of[0].is_number() || !of[1].is_number()) return {};
    const auto side = [&](std::size_t i) {
        return int(std::clamp<double>(of[i].get<double>(), 0, max_image_side));
    };
    return {side(0), side(1)};
}

}  // namespace

Json to_json(QSize size, const QRect& region) {
    if (region.isEmpty()) return nullptr;
    return {{"of", {size.width(), size.height()}},
            {"x", region.x()},
            {"y", region.y()},
            {"width", region.width()},
            {"height", region.height()}};
}

std::pair<QSize, QRect> region_from_json(const Json& json) {
    const QSize size = size_from_json(member_or_null(json, "of"));
    const QRect region(field_or(json, "x", 0), field_or(json, "y", 0), field_or(json, "width", 0),
                       field_or(json, "height", 0));
    const QRect inside = region & QRect(QPoint(0, 0), size);
    return inside.isEmpty() ? std::pair<QSize, QRect>() : std::pair(size, inside);
}

Json to_json(QSize size, const QLine& line) {
    if (line.isNull()) return nullptr;
    return {{"of", {size.width(), size.height()}},
            {"x1", line.x1()},
            {"y1", line.y1()},
            {"x2", line.x2()},
            {"y2", line.y2()}};
}

std::pair<QSize, QLine> line_from_json(const Json& json) {
    const QSize size = size_from_json(member_or_null(json, "of"));
    const QLine line(field_or(json, "x1", 0), field_or(json, "y1", 0), field_or(json, "x2", 0),
                     field_or(json, "y2", 0));
    const QRect picture(QPoint(0, 0), size);
    const bool fits = !line.isNull() && picture.contains(line.p1()) && picture.contains(line.p2());
    return fits ? std::pair(size, line) : std::pair<QSize, QLine>();
}

Json to_json(const widgets::CameraPose& pose) {
    return {{"eye", to_json(pose.eye)},
            {"target", to_json(pose.target)},
            {"up", to_json(pose.up)},
            {"fov_y_degrees", pose.fov_y_degrees},
            {"orthographic", pose.orthographic},
            {"height", pose.height}};
}

std::optional<widgets::CameraPose> pose_from_json(const Json& json) {
    const auto eye = vector_from_json(member_or_null(json, "eye"));
    const auto target = vector_from_json(member_or_null(json, "target"));
    const auto up = vector_from_json(member_or_null(json, "up"));
    if (!eye || !target || !up || *eye == *target) return {};
    widgets::CameraPose pose{{*eye, *target, *up}};
    const auto within = [&](const char* key, double standard) {
        const auto& range = projects::field_of(projects::camera_fields(), key).text.range;
        return std::clamp(field_or(json, key, standard), range.min, range.max);
    };
    pose.fov_y_degrees = within("fov_y_degrees", pose.fov_y_degrees);
    pose.orthographic = field_or(json, "orthographic", false);
    pose.height = within("height", pose.height);
    return pose;
}

Json to_json(const widgets::ViewState& state) {
    Json json = {{"a", to_json(state.a)},
                 {"b", to_json(state.b)},
                 {"mode", widgets::to_key(state.mode)},
                 {"difference", widgets::to_key(state.difference)},
                 {"as_table", state.as_table}};
    for (const auto& source : state.more) json["more"].push_back(to_json(source));
    json["chain"] = state.chain;
    json["pair"] = {state.pair.a, state.pair.b};
    auto& space = json["space"];
    space = {{"show_scene", state.space.show_scene}, {"show_centres", state.space.show_centres}};
    if (state.space.camera) space["camera"] = to_json(*state.space.camera);
    for (const auto& layer : state.space.layers) space["layers"].push_back(to_json(layer));
    return json;
}

widgets::ViewState view_state_from_json(const Json& json) {
    widgets::ViewState state;
    state.a = source_from_json(member_or_null(json, "a"));
    state.b = source_from_json(member_or_null(json, "b"));
    state.mode = widgets::mode_from_key(field_or(json, "mode", std::string()));
    state.difference = widgets::difference_from_key(field_or(json, "difference", std::string()));
    state.as_table = field_or(json, "as_table", false);
    for (const auto& source : member_or_null(json, "more"))
        if (state.more.size() < max_items) state.more.push_back(source_from_json(source));
    state.chain = field_or(json, "chain", false);
    state.pair = pair_from_json(member_or_null(json, "pair"));
    const auto& space = member_or_null(json, "space");
    state.space.show_scene = field_or(space, "show_scene", true);
    state.space.show_centres = field_or(space, "show_centres", true);
    state.space.camera = pose_from_json(member_or_null(space, "camera"));
    for (const auto& layer : member_or_null(space, "layers"))
        if (state.space.layers.size() < max_items) state.space.layers.push_back(layer_from_json(layer));
    return state;
}

}  // namespace ir::gui
