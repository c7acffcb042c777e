#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderers/core/output.h"
#include "renderers/core/report.h"
#include "renderers/image/image.h"
#include "renderers/scene/scene.h"

/// What the 3D viewer draws: any buffer that is a point set, a line set, glyphs or sphere values, over the
/// flat-shaded scene. Everything is told by kind and by the names of fields, never by method:
///
/// point_set      position f32×3; optional normal f32×3
/// line_set       start f32×3, end f32×3: one segment an element
/// glyphs         centre f32×3 and: normal f32×3, radius f32 (disc); axis_u, axis_v f32×3 (parallelogram with
///                these half-sides); axis_u, axis_v, axis_w f32×3 (ellipsoid with these half-axes)
/// sphere_values  centre f32×3 (unit direction); optional colatitude f32×2 and longitude f32×2 (bounds of its
///                region in radians, colatitude from +Y, longitude from +X towards +Z); drawn as a unit
///                sphere of regions, or of the nearest centre where bounds are absent
///
/// A point set with `place` f32×3 instead of `position` stands in a space of its own, such as the unit square
/// of a map. It is drawn without the scene and only among its like, framed to their bounds.
///
/// Positions are world space, metres. All other fields are values: a layer can be coloured and filtered by
/// them.
namespace ir::passes::viewers {

/// The grey behind a 3D view, linear in the picture: this sRGB code, which is also what surrounds images in
/// the 2D views, so that a view has no frame.
inline constexpr int surround_code = 118;

/// Shows only elements whose field (first component) lies in low … high.
struct Filter {
    std::string field;
    double low = 0, high = 0;
    bool operator==(const Filter&) const = default;
};

/// One buffer as the viewer draws it. What it has no field, map or room for (beyond 8 filters) is left out
/// and said in the note. Elements whose place is not finite are skipped; those whose value is not finite are
/// nearly black.
struct Layer {
    std::string key;             ///< resource
    std::string colour_by = {};  ///< field; "facing" (side that is seen, by normal); empty: one colour
    int component = 0;           ///< of that field
    std::optional<double> low = {}, high = {};  ///< range of the colour map; absent: from the elements drawn
    std::string colour_map = "viridis";
    float size_px = 3;  ///< of points and lines, 1 … 64
    static constexpr float min_opacity = 0.01f;
    /// min_opacity … 1; below 1 elements hide nothing, and mix in any order; not of spheres.
    float opacity = 1;
    std::vector<Filter> filters = {};
    std::int64_t selected = -1;  ///< element that is marked
    bool operator==(const Layer&) const = default;
};

struct Scene3D {
    std::optional<scene::Camera> camera = {};  ///< absent: the experiment's
    int width = 0, height = 0;
    int oversampling =
        1;  ///< 2 … 4: each pixel is the mean of so many squared, for pictures that stand still
    bool show_scene =
        true;  ///< flat shaded, holes of alpha masks filled; not where all layers are spheres of values
    bool show_centres = true;                ///< of regions on the sphere
    std::uint64_t max_elements = 4'000'000;  ///< per layer (spheres: 32,768); beyond, every n-th is drawn
    std::vector<Layer> layers = {};
    std::string after = {};  ///< layers are as they were when this pass had run; empty: as they are
};

/// What became of a layer.
struct DrawnLayer {
    std::string key, note;  ///< why it is not drawn, or not as requested; empty: all is well
    OutputKind kind = OutputKind::table;
    std::vector<Field> fields;
    std::uint64_t elements = 0;  ///< in the buffer
    std::uint64_t stride = 1;    ///< every n-th was looked at, for the ranges too
    std::uint64_t passing = 0;   ///< of those, how many have a place and pass the filters: they are drawn
    double low = 0, high = 0;    ///< range of the colours that was used
    double min = 0, max = 0;     ///< of the field that colours, over all elements that pass the filters
    /// Where that field's numbers are names: those that occur; their colours count, and no colour map.
    std::vector<Category> categories = {};
};

/// The picture and what stands at each of its pixels.
struct Picture3D {
    Image colour;                       ///< 3 channels, linear; row 0 on top
    std::vector<std::int32_t> layer;    ///< per pixel: index of the layer, -1 none
    std::vector<std::int64_t> element;  ///< per pixel: element of that layer, -1 none
    std::vector<DrawnLayer> layers;
    scene::Camera camera;  ///< that was used
};

}  // namespace ir::passes::viewers
