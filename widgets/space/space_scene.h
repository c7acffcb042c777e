#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderers/core/output.h"
#include "renderers/core/report.h"
#include "renderers/image/image.h"
#include "widgets/image/camera_motion.h"

/// What a 3D view shows, as plain data. The window turns it into a request to the render thread and the
/// answer back into a SpacePicture.
namespace ir::widgets {

/// Shows only elements whose field (first component) lies in low … high.
struct SpaceFilter {
    std::string field;
    double low = 0, high = 0;
    bool operator==(const SpaceFilter&) const = default;
};

/// One buffer as it is drawn. The same buffer may stand in several layers.
struct SpaceLayer {
    static constexpr const char* facing = "facing";  ///< colour_by: which side of the surface is seen
    static constexpr float min_opacity = 0.01f;

    std::string key;  ///< of the buffer
    std::string label;
    OutputKind kind = OutputKind::point_set;
    std::string colour_by;            ///< field, `facing`, or empty: one colour
    int component = 0;                ///< of that field
    std::optional<double> low, high;  ///< range of the colour map; absent: from the elements drawn
    std::string colour_map = "viridis";
    float size_px = 3;  ///< of points and lines, logical pixels
    float opacity = 1;  ///< at least min_opacity; below 1 elements hide nothing; spheres have none
    std::vector<SpaceFilter> filters;
    bool visible = true;
    std::int64_t selected = -1;  ///< element that is marked
    bool operator==(const SpaceLayer&) const = default;
};

struct SpaceScene {
    std::optional<CameraPose> camera;  ///< absent: the experiment's
    bool show_scene = true;            ///< flat shaded
    bool show_centres = true;          ///< of regions on a sphere
    std::vector<SpaceLayer> layers;
    bool operator==(const SpaceScene&) const = default;
};

struct SpaceBox {
    glm::dvec3 low{-1}, high{1};
    bool operator==(const SpaceBox&) const = default;
};

struct FieldRange {
    double low = 0, high = 0;
    bool operator==(const FieldRange&) const = default;
};

/// What became of a layer, in the order of the visible layers.
struct LayerInfo {
    std::string key;
    std::string note = {};           ///< why it is not drawn, or not as requested; empty: all is well
    std::vector<Field> fields = {};  ///< of the buffer's element
    /// By field, of its first component over all elements, filters or not; empty: unknown.
    std::vector<std::optional<FieldRange>> ranges = {};
    std::uint64_t elements = 0;                 ///< in the buffer
    std::uint64_t stride = 1;                   ///< every n-th was looked at
    std::optional<std::uint64_t> passing = {};  ///< of those, how many pass the filters; absent: unknown
    double low = 0, high = 0;                   ///< range of the colours that was used
    double min = 0, max = 0;                    ///< of the field that colours, over the elements that pass
    /// Where the field that colours holds names: those that occur, and no colour map.
    std::vector<Category> categories = {};
    SpaceLayer requested = {};            ///< what it was drawn for; SpaceView fills it in
    std::optional<SpaceBox> bounds = {};  ///< metres; absent: unknown
};

/// What the renderer drew, and what stands at each pixel.
struct SpacePicture {
    Image colour;                       ///< linear, 3 channels, row 0 on top
    std::vector<std::int32_t> layer;    ///< by pixel: index into `layers`, -1 none
    std::vector<std::int64_t> element;  ///< by pixel: element of that layer, -1 none
    std::vector<LayerInfo> layers;
    CameraPose camera;  ///< that was used
    QString moment;     ///< within the frame that it shows; empty: its end
    /// What it is the answer to; null: the last scene that was asked for.
    std::shared_ptr<const SpaceScene> scene = {};
};

/// An element of a layer of a scene; -1 and -1: the background.
struct SpaceElement {
    int layer = -1;
    std::int64_t element = -1;
    bool operator==(const SpaceElement&) const = default;
};

/// A buffer that could be drawn.
struct AvailableBuffer {
    std::string key, label;
    OutputKind kind = OutputKind::point_set;
    std::string doc = {};
    std::vector<Field> fields = {};
    std::string group = {};  ///< of lists: results, or the pass that writes it
    bool operator==(const AvailableBuffer&) const = default;
};

/// A list of things that are shown one by one. Elements that stand for an item have an integer field of the
/// selector's key.
struct SpaceSelector {
    static constexpr int all = -1;
    std::string key, label = {}, doc = {};
    int count = 1;
    int item = 0;  ///< from 0 on, or `all`
    bool operator==(const SpaceSelector&) const = default;
};

/// Kinds that a 3D view can draw.
bool is_spatial(OutputKind kind);
/// Where elements stand: in the scene, in a space of their own such as the unit square of a map (told by the
/// field "place"), or on the sphere of directions. A view shows one of them.
enum class Space { scene, own, sphere };
Space space_of(OutputKind kind, const std::vector<Field>& fields);
/// Fields that place elements ("position", "place", "normal", "axis_u", …) rather than being values of them.
bool is_geometry(OutputKind kind, const Field& field);
/// By how a buffer is drawn before anybody chooses otherwise. Sphere values: by the first value that is no
/// id; everything else: by "layer", "bounce", "depth", "distance" or the first scalar. Glyphs with "layer"
/// and "depth" are a stack, and translucent.
SpaceLayer default_layer(const AvailableBuffer& buffer);
/// Gives a scene layers in place of those it has. What is translucent shows what is behind, which the scene's
/// own surfaces would hide.
void begin_with(SpaceScene& scene, std::vector<SpaceLayer> layers);
/// Whether a visible layer is a sphere of values: it is seen from outside, without the scene.
bool shows_sphere(const SpaceScene& scene);
/// By picture layer: index in `layers` of the visible layer that it shows, -1 where that is gone.
std::vector<int> scene_indices(const std::vector<LayerInfo>& drawn, const std::vector<SpaceLayer>& layers);
/// The element that is drawn nearest to a pixel, at most `reach` pixels away; of layers with a place in
/// `indices` [scene_indices].
SpaceElement element_near(const SpacePicture& picture, const std::vector<int>& indices, QPoint pixel,
                          int reach);
/// The box around all layers that have elements; absent without any.
std::optional<SpaceBox> bounds_of(const std::vector<LayerInfo>& layers);

}  // namespace ir::widgets
