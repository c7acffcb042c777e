#include "tests/gui/widgets/space/fake_space.h"

#include <algorithm>
#include <cmath>

#include "renderers/image/colour_map.h"
#include "widgets/space/space_camera.h"

namespace ir::widgets::test {
namespace {

constexpr int layers_of_points = 3;

glm::dvec3 point(int i, int count) {
    const double y = 1 - 2 * (i + 0.5) / count, r = std::sqrt(1 - y * y), angle = 2.399963 * i;
    return {r * std::cos(angle), y, r * std::sin(angle)};
}

void splat(SpacePicture& picture, QPointF at, double size, int layer, std::int64_t element,
           const std::array<unsigned char, 3>& colour) {
    const int x0 = int(std::round(at.x() - size / 2)), y0 = int(std::round(at.y() - size / 2));
    for (int y = y0; y < y0 + std::max(1, int(size)); ++y)
        for (int x = x0; x < x0 + std::max(1, int(size)); ++x) {
            if (x < 0 || y < 0 || x >= picture.colour.width || y >= picture.colour.height) continue;
            const auto pixel = std::size_t(y) * picture.colour.width + x;
            picture.layer[pixel] = layer;
            picture.element[pixel] = element;
            for (int c = 0; c < 3; ++c)
                picture.colour.at(x, y, c) = linear_from_srgb(float(colour[std::size_t(c)]) / 255);
        }
}

bool passes(const SpaceLayer& layer, double value) {
    return std::all_of(layer.filters.begin(), layer.filters.end(), [&](const SpaceFilter& filter) {
        return filter.field != "layer" || (value >= filter.low && value <= filter.high);
    });
}

}  // namespace

AvailableBuffer FakeSpace::buffer() {
    return {.key = "depths",
            .label = "Depths",
            .kind = OutputKind::point_set,
            .doc = "All depths of the map shown.",
            .fields = {{"position", FieldType::f32, 3},
                       {"normal", FieldType::f32, 3},
                       {"depth", FieldType::f32, 1},
                       {"layer", FieldType::u32, 1},
                       {"radiance", FieldType::f32, 3}}};
}

AvailableBuffer FakeSpace::directions() {
    return {
        .key = "directions",
        .label = "Directions",
        .kind = OutputKind::sphere_values,
        .doc = "The partition of the sphere.",
        .fields = {
            {"centre", FieldType::f32, 3}, {"map", FieldType::u32, 1}, {"accessibility", FieldType::f32, 1}}};
}

SpacePicture FakeSpace::draw(const SpaceScene& scene, QSize size) {
    SpacePicture picture;
    picture.camera = scene.camera.value_or(experiment);
    cameras.push_back(picture.camera);
    picture.colour = Image(size.width(), size.height(), 3, linear_from_srgb(118 / 255.0f));
    picture.layer.assign(std::size_t(size.width()) * size.height(), -1);
    picture.element.assign(picture.layer.size(), -1);
    const CameraAxes axes = camera_axes(picture.camera);
    for (const SpaceLayer& layer : scene.layers) {
        if (!layer.visible) continue;
        LayerInfo info;
        info.key = layer.key;
        info.fields = layer.kind == OutputKind::sphere_values ? directions().fields : fields;
        info.elements = std::uint64_t(points);
        info.low = info.min = 1e9;
        info.high = info.max = -1e9;
        info.bounds = SpaceBox{};
        info.requested = layer;
        const int drawn = int(picture.layers.size());
        for (int i = 0; i < points; ++i) {
            const double value = i % layers_of_points;
            if (!passes(layer, value)) continue;
            info.passing = info.passing.value_or(0) + 1;
            info.min = std::min(info.min, value);
            info.max = std::max(info.max, value);
            const glm::dvec3 from_eye = point(i, points) - picture.camera.eye;
            const double depth = glm::dot(from_eye, axes.forward);
            if (depth <= 0) continue;
            const double half = std::tan(glm::radians(picture.camera.fov_y_degrees) / 2) * depth;
            const double scale = size.height() / (2 * half);
            const QPointF at(size.width() / 2.0 + glm::dot(from_eye, axes.right) * scale,
                             size.height() / 2.0 - glm::dot(from_eye, axes.up) * scale);
            const auto& colour = colour_map(layer.colour_map)[std::size_t(40 + 85 * int(value))];
            splat(picture, at, i == layer.selected ? 2 * layer.size_px : layer.size_px, drawn, i, colour);
        }
        info.low = layer.low.value_or(info.min);
        info.high = layer.high.value_or(info.max);
        picture.layers.push_back(info);
    }
    return picture;
}

QPoint in_view(const SpaceView& view, QPointF picture_px) {
    return (picture_px / view.devicePixelRatioF()).toPoint() + view.picture_area().topLeft();
}

QPointF place_of(const SpacePicture& picture, int layer, std::int64_t element) {
    QPointF sum;
    int count = 0;
    for (std::size_t i = 0; i < picture.layer.size(); ++i) {
        if (picture.layer[i] != layer || picture.element[i] != element) continue;
        const int width = picture.colour.width;
        sum += QPointF(int(i) % width + 0.5, int(i) / width + 0.5);
        ++count;
    }
    return count > 0 ? sum / count : QPointF(-1, -1);
}

}  // namespace ir::widgets::test
