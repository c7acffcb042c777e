#include "renderers/passes/viewers/layer_painter.h"

#include <algorithm>
#include <numbers>
#include <span>

#include "renderers/image/colour_map.h"
#include "renderers/passes/gbuffer/pixel_rays.h"

namespace ir::passes::viewers {
namespace {

/// Software drivers end loops silently after 65,535 iterations, one for each sample of a point's square.
constexpr float max_point_samples = 200;
constexpr int corners = 6;  ///< vertices of a quad

gl::ImageShape map_shape() {
    gl::ImageShape shape;
    shape.width = 256;
    shape.format = gl::Format::rgba32f;
    return shape;
}

/// Tells lists of colours from each other.
std::string name_of(const std::vector<Category>& categories) {
    std::string name = "categories";
    for (const auto& [value, label, colour] : categories) {
        name += ' ' + std::to_string(value) + ':';
        for (const auto part : colour) name += std::to_string(part) + ',';
    }
    return name;
}

std::vector<std::string> shaders_of(Primitive primitive) {
    switch (primitive) {
        case Primitive::lines:
            return {"passes/viewers/lines.vert", "passes/viewers/lines.frag"};
        case Primitive::ellipsoids:
            return {"passes/viewers/ellipsoids.vert", "passes/viewers/ellipsoids.frag"};
        default:
            return {"passes/viewers/flat_glyphs.vert", "passes/viewers/flat_glyphs.frag"};
    }
}

/// Constants of lines.vert and lines.frag.
struct Lines {
    Projection projection;
    unsigned layer_number;
    float line_px;
    IR_FIELDS(projection, layer_number, line_px)
};

/// Constants of flat_glyphs.vert and flat_glyphs.frag.
struct FlatGlyphs {
    Projection projection;
    Shade shade;
    unsigned layer_number;
    bool round;
    float point_px;
    IR_FIELDS(projection, shade, layer_number, round, point_px)
};

/// Constants of ellipsoids.vert and ellipsoids.frag.
struct Ellipsoids {
    Projection projection;
    Shade shade;
    PixelRays rays;
    unsigned layer_number;
    IR_FIELDS(projection, shade, rays, layer_number)
};

/// Constants of put.glsl where it is translucent.
struct Translucency {
    float opacity, near_plane, far_plane;
    bool has_linear_depth;
    IR_FIELDS(opacity, near_plane, far_plane, has_linear_depth)
};

/// Constants of points_begin.comp, and what points.comp and points.frag share with it.
struct Points {
    Projection projection;
    float point_px;
    IR_FIELDS(projection, point_px)
};

/// Constants of points.comp.
struct CompetingPoints {
    Points points;
    unsigned elements_per_invocation;
    bool name_elements;
    IR_FIELDS(points, elements_per_invocation, name_elements)
};

/// Constants of points.frag.
struct NearestPoints {
    Points points;
    float pixel_samples;
    IR_FIELDS(points, pixel_samples)
};

/// Constants of sphere.comp.
struct SphereRegions {
    Eye eye;
    PixelRays rays;
    glm::ivec2 picture_size;
    IR_FIELDS(eye, rays, picture_size)
};

/// Constants of sphere.frag.
struct Sphere {
    Projection projection;
    PixelRays rays;
    Shade shade;
    int selected;
    bool show_centres;
    int pixel_samples;
    float mean_region_px;
    IR_FIELDS(projection, rays, shade, selected, show_centres, pixel_samples, mean_region_px)
};

/// Constants of mark.vert.
struct Mark {
    Projection projection;
    unsigned marked;
    int segments;
    float ring_px, band_px;
    glm::vec3 mark_colour;
    bool own_colour;
    IR_FIELDS(projection, marked, segments, ring_px, band_px, mark_colour, own_colour)
};

}  // namespace

LayerPainter::LayerPainter(const Tools& tools)
    : tools_(tools), measures_(tools.device), nearest_keys_(tools.device), nearest_elements_(tools.device) {
    tools_.api.CreateVertexArrays(1, &vertex_array_);
}

LayerPainter::~LayerPainter() {
    tools_.api.DeleteVertexArrays(1, &vertex_array_);
    for (const auto& [name, texture] : maps_) tools_.device.destroy_image(texture);
}

gl::Name LayerPainter::map_texture(const LayerPlan& plan) {
    const auto name = plan.categories.empty() ? plan.wanted.colour_map : name_of(plan.categories);
    const auto known = maps_.find(name);
    if (known != maps_.end()) return known->second;
    const ColourMap colours = plan.categories.empty() ? colour_map(name) : step_map(plan.categories).colours;
    std::vector<glm::vec4> texels;
    for (const auto& entry : colours) texels.emplace_back(linear_from_srgb(entry), 1);
    const auto texture = tools_.device.create_image(map_shape(), "colour map " + name);
    tools_.device.write_image(texture, map_shape(), 0, 0, std::as_bytes(std::span(texels)));
    return maps_[name] = texture;
}

void LayerPainter::write_block(const LayerPlan& plan, std::size_t index) {
    while (blocks_.size() <= index) blocks_.push_back(std::make_unique<DeviceStore>(tools_.device));
    blocks_[index]->write(std::as_bytes(std::span(&plan.block, 1)), "3D view, layer");
}

const gl::Program& LayerPainter::begin(const LayerPlan& plan, std::size_t index,
                                       const gl::ProgramSource& source) {
    write_block(plan, index);
    const auto& program = tools_.programs.get(source);
    program.use();
    program.bind_buffer("Elements", plan.buffer);
    program.bind_buffer("LayerBlock", blocks_[index]->name());
    tools_.api.BindVertexArray(vertex_array_);
    return program;
}

void LayerPainter::draw(const LayerPlan& plan, std::size_t index, const Sight& sight, Target& target,
                        bool show_centres) {
    if (plan.primitive == Primitive::sphere) return draw_sphere(plan, index, sight, target, show_centres);
    if (plan.primitive == Primitive::points) return draw_points(plan, index, sight, target);
    draw_shapes(plan, index, sight);
}

void LayerPainter::draw_translucent(const std::vector<LayerPlan>& plans, const Sight& sight, Target& target) {
    const auto& gl = tools_.api;
    const auto draw_all = [&](auto&& draw_one) {
        for (std::size_t i = 0; i < plans.size(); ++i)
            if (plans[i].is_translucent()) draw_one(plans[i], i);
    };
    target.begin_translucent();
    gl.DepthMask(GL_FALSE);
    gl.Enable(GL_BLEND);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.BlendFunc(GL_ONE, GL_ONE);
    draw_all([&](const LayerPlan& plan, std::size_t i) { draw_shapes(plan, i, sight); });
    target.end_translucent();
    gl.ColorMaski(1, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    compose(target);
    gl.ColorMaski(1, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.Disable(GL_BLEND);
    gl.DepthMask(GL_TRUE);
    gl.ColorMaski(0, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_all([&](LayerPlan plan, std::size_t i) {
        plan.opacity = 1;
        draw(plan, i, sight, target, false);
    });
    gl.ColorMaski(0, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void LayerPainter::compose(const Target& target) {
    const auto& gl = tools_.api;
    gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    const auto& program = tools_.programs.get({{"lib/full_screen.vert", "passes/viewers/compose.frag"}});
    program.use();
    program.bind_texture("weighted", target.weighted());
    program.bind_texture("optical_depth", target.optical_depth());
    gl.BindVertexArray(vertex_array_);
    gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl.Disable(GL_DEPTH_TEST);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.Enable(GL_DEPTH_TEST);
}

void LayerPainter::draw_shapes(const LayerPlan& plan, std::size_t index, const Sight& sight) {
    const auto& gl = tools_.api;
    gl::ProgramSource source{shaders_of(plan.primitive)};
    if (plan.is_translucent()) source.defines["TRANSLUCENT"] = "1";
    const auto& program = begin(plan, index, source);
    if (plan.is_translucent())
        program.set(Translucency{.opacity = plan.opacity,
                                 .near_plane = sight.view.near_plane,
                                 .far_plane = sight.view.far_plane,
                                 .has_linear_depth = sight.orthographic});
    program.bind_texture("colour_map", map_texture(plan));
    const auto count = static_cast<GLsizei>(plan.block.drawn);
    const auto samples = static_cast<float>(sight.pixel_samples);
    if (plan.primitive == Primitive::lines)
        program.set(Lines{projection(sight), plan.block.number, plan.block.size_px * samples});
    else if (plan.primitive == Primitive::ellipsoids)
        program.set(Ellipsoids{.projection = projection(sight),
                               .shade = shade(sight),
                               .rays = pixel_rays(sight.view),
                               .layer_number = plan.block.number});
    else
        program.set(FlatGlyphs{.projection = projection(sight),
                               .shade = shade(sight),
                               .layer_number = plan.block.number,
                               .round = plan.primitive != Primitive::parallelograms,
                               .point_px = plan.block.size_px * samples});
    gl.DrawArrays(GL_TRIANGLES, 0, corners * count);
}

void LayerPainter::draw_points(const LayerPlan& plan, std::size_t index, const Sight& sight,
                               const Target& target) {
    const auto& gl = tools_.api;
    const auto samples = static_cast<float>(sight.pixel_samples);
    const Points points{projection(sight), std::min(plan.block.size_px * samples, max_point_samples)};
    const auto bytes = sizeof(std::uint32_t) * static_cast<std::size_t>(sight.view.width) *
                       static_cast<std::size_t>(sight.view.height);
    nearest_keys_.reserve(bytes, "3D view, nearest depths of points");
    nearest_elements_.reserve(bytes, "3D view, nearest points");
    const auto bind = [&](const gl::Program& program) {
        program.bind_buffer("NearestKeys", nearest_keys_.name());
        program.bind_buffer("NearestElements", nearest_elements_.name());
    };
    const auto& first = begin(plan, index, {{"passes/viewers/points_begin.comp"}});
    bind(first);
    first.set(points);
    first.bind_texture("depth_behind", target.depth());
    first.dispatch(sight.view.width, sight.view.height);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);

    const auto& compete = begin(plan, index, {{"passes/viewers/points.comp"}});
    bind(compete);
    for (const bool name_elements : {false, true}) {
        compete.set(CompetingPoints{points, elements_per_invocation, name_elements});
        compete.dispatch((plan.block.drawn + elements_per_invocation - 1) / elements_per_invocation);
        gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }

    const auto& program = begin(plan, index, {{"lib/full_screen.vert", "passes/viewers/points.frag"}});
    bind(program);
    program.bind_texture("colour_map", map_texture(plan));
    program.set(NearestPoints{points, samples});
    gl.DepthFunc(GL_ALWAYS);  // they have competed with what is there already
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.DepthFunc(GL_LEQUAL);
}

void LayerPainter::draw_sphere(const LayerPlan& plan, std::size_t index, const Sight& sight, Target& target,
                               bool show_centres) {
    const auto& gl = tools_.api;
    const int width = sight.view.width, height = sight.view.height;
    const auto regions = target.regions();
    const auto& find = begin(plan, index, {{"passes/viewers/sphere.comp"}});
    find.set(SphereRegions{eye(sight), pixel_rays(sight.view), {width, height}});
    find.bind_image("regions", regions, gl::Format::r32ui);
    find.dispatch(width, height);
    gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);

    const auto& program = begin(plan, index, {{"lib/full_screen.vert", "passes/viewers/sphere.frag"}});
    program.bind_texture("colour_map", map_texture(plan));
    program.bind_texture("regions", regions);
    // of a sphere at the middle of the picture; regions cover it twice, in front and behind
    const auto& clip_from_view = sight.view.clip_from_view;
    const float depth = sight.orthographic ? 1 : std::max(1.0f, glm::length(sight.view.eye_ws));
    const float radius_px =
        0.5f * static_cast<float>(height / sight.pixel_samples) * clip_from_view[1][1] / depth;
    program.set(
        Sphere{.projection = projection(sight),
               .rays = pixel_rays(sight.view),
               .shade = shade(sight),
               .selected = static_cast<int>(std::clamp<std::int64_t>(plan.wanted.selected, -1, INT32_MAX)),
               .show_centres = show_centres,
               .pixel_samples = sight.pixel_samples,
               .mean_region_px = 2 * std::numbers::pi_v<float> * radius_px * radius_px /
                                 static_cast<float>(std::max<std::uint32_t>(1, plan.block.drawn))});
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

void LayerPainter::mark(const LayerPlan& plan, std::size_t index, const Sight& sight) {
    const auto selected = plan.wanted.selected;
    if (selected < 0 || static_cast<std::uint64_t>(selected) >= plan.drawn.elements) return;
    if (plan.primitive == Primitive::sphere) return;  // marked where its region is drawn
    const auto& gl = tools_.api;
    const auto& program = begin(plan, index, {{"passes/viewers/mark.vert", "passes/viewers/mark.frag"}});
    const int segments = plan.primitive == Primitive::lines            ? 1
                         : plan.primitive == Primitive::parallelograms ? 4
                                                                       : 64;
    const auto samples = static_cast<float>(sight.pixel_samples);
    Mark constants{.projection = projection(sight),
                   .marked = static_cast<unsigned>(selected),
                   .segments = segments,
                   .ring_px = samples * (0.5f * plan.block.size_px + 5),
                   .band_px = 0,
                   .mark_colour = {},
                   .own_colour = false};
    const bool is_line = plan.primitive == Primitive::lines;
    if (is_line) program.bind_texture("colour_map", map_texture(plan));
    const auto band = [&](float width_px, glm::vec3 colour, bool own_colour) {
        constants.band_px = samples * width_px;
        constants.mark_colour = colour;
        constants.own_colour = own_colour;
        program.set(constants);
        gl.DrawArrays(GL_TRIANGLES, 0, corners * segments);
    };
    const float own_px = is_line ? plan.block.size_px + 1 : 0;
    band(own_px + 5, glm::vec3(0), false);
    band(own_px + 2, glm::vec3(1), false);
    if (is_line) band(own_px - 1, glm::vec3(0), true);  // between white sides
}

}  // namespace ir::passes::viewers
