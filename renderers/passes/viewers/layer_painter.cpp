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

}  // namespace

LayerPainter::LayerPainter(const Tools& tools)
    : tools_(tools), measures_(tools.device), nearest_keys_(tools.device), nearest_elements_(tools.device) {
    tools_.api.CreateVertexArrays(1, &vertex_array_);
}

LayerPainter::~LayerPainter() {
    tools_.api.DeleteVertexArrays(1, &vertex_array_);
    for (const auto& [name, texture] : maps_) tools_.device.destroy_image(texture);
}

gl::Name LayerPainter::map_texture(const std::string& name) {
    const auto known = maps_.find(name);
    if (known != maps_.end()) return known->second;
    std::vector<glm::vec4> texels;
    for (const auto& entry : colour_map(name))
        texels.emplace_back(linear_from_srgb(entry[0] / 255.0f), linear_from_srgb(entry[1] / 255.0f),
                            linear_from_srgb(entry[2] / 255.0f), 1);
    const auto texture = tools_.device.create_image(map_shape(), "colour map " + name);
    tools_.device.write_image(texture, map_shape(), 0, 0, std::as_bytes(std::span(texels)));
    return maps_[name] = texture;
}

void LayerPainter::write_block(const LayerPlan& plan, std::size_t index) {
    while (blocks_.size() <= index) blocks_.push_back(std::make_unique<DeviceStore>(tools_.device));
    blocks_[index]->write(std::as_bytes(std::span(&plan.block, 1)), "3D view, layer");
}

const gl::Program& LayerPainter::begin(const LayerPlan& plan, std::size_t index, const Sight& sight,
                                       std::vector<std::string> files) {
    write_block(plan, index);
    const auto& program = tools_.programs.get({std::move(files)});
    program.use();
    program.bind_buffer("Elements", plan.buffer);
    program.bind_buffer("LayerBlock", blocks_[index]->name());
    set_eye(program, sight);
    tools_.api.BindVertexArray(vertex_array_);
    return program;
}

void LayerPainter::draw(const LayerPlan& plan, std::size_t index, const Sight& sight, Target& target,
                        bool show_centres) {
    if (plan.primitive == Primitive::sphere) return draw_sphere(plan, index, sight, target, show_centres);
    if (plan.primitive == Primitive::points) return draw_points(plan, index, sight, target);
    const auto& gl = tools_.api;
    const auto& program = begin(plan, index, sight, shaders_of(plan.primitive));
    set_projection(program, sight);
    program.set("layer_number", plan.block.number);
    program.bind_texture("colour_map", map_texture(plan.wanted.colour_map));
    const auto count = static_cast<GLsizei>(plan.block.drawn);
    const auto samples = static_cast<float>(sight.pixel_samples);
    if (plan.primitive == Primitive::lines) {
        program.set("line_px", plan.block.size_px * samples);
    } else {
        set_shade(program, sight);
        if (plan.primitive == Primitive::ellipsoids)
            set_pixel_rays(program, sight.view);
        else
            program.set("round", plan.primitive == Primitive::discs ? 1 : 0);
    }
    gl.DrawArrays(GL_TRIANGLES, 0, corners * count);
}

void LayerPainter::draw_points(const LayerPlan& plan, std::size_t index, const Sight& sight,
                               const Target& target) {
    const auto& gl = tools_.api;
    const auto samples = static_cast<float>(sight.pixel_samples);
    const float point_px = std::min(plan.block.size_px * samples, max_point_samples);
    const auto bytes = sizeof(std::uint32_t) * static_cast<std::size_t>(sight.view.width) *
                       static_cast<std::size_t>(sight.view.height);
    nearest_keys_.reserve(bytes, "3D view, nearest depths of points");
    nearest_elements_.reserve(bytes, "3D view, nearest points");
    const auto bind = [&](const gl::Program& program) {
        set_projection(program, sight);
        program.set("point_px", point_px);
        program.bind_buffer("NearestKeys", nearest_keys_.name());
        program.bind_buffer("NearestElements", nearest_elements_.name());
    };
    const auto& first = begin(plan, index, sight, {"passes/viewers/points_begin.comp"});
    bind(first);
    first.bind_texture("depth_behind", target.depth());
    first.dispatch(sight.view.width, sight.view.height);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);

    const auto& compete = begin(plan, index, sight, {"passes/viewers/points.comp"});
    bind(compete);
    compete.set("elements_per_invocation", elements_per_invocation);
    for (const int name_elements : {0, 1}) {
        compete.set("name_elements", name_elements);
        compete.dispatch((plan.block.drawn + elements_per_invocation - 1) / elements_per_invocation);
        gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }

    const auto& program = begin(plan, index, sight, {"lib/full_screen.vert", "passes/viewers/points.frag"});
    bind(program);
    program.bind_texture("colour_map", map_texture(plan.wanted.colour_map));
    program.set("pixel_samples", samples);
    gl.DepthFunc(GL_ALWAYS);  // they have competed with what is there already
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.DepthFunc(GL_LEQUAL);
}

void LayerPainter::draw_sphere(const LayerPlan& plan, std::size_t index, const Sight& sight, Target& target,
                               bool show_centres) {
    const auto& gl = tools_.api;
    const int width = sight.view.width, height = sight.view.height;
    const auto regions = target.regions();
    const auto& find = begin(plan, index, sight, {"passes/viewers/sphere.comp"});
    set_pixel_rays(find, sight.view);
    find.set("picture_size", glm::ivec2(width, height));
    find.bind_image("regions", regions, gl::Format::r32ui);
    find.dispatch(width, height);
    gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);

    const auto& program = begin(plan, index, sight, {"lib/full_screen.vert", "passes/viewers/sphere.frag"});
    set_pixel_rays(program, sight.view);
    set_projection(program, sight);
    set_shade(program, sight);
    program.bind_texture("colour_map", map_texture(plan.wanted.colour_map));
    program.bind_texture("regions", regions);
    program.set("selected", static_cast<int>(std::clamp<std::int64_t>(plan.wanted.selected, -1, INT32_MAX)));
    program.set("show_centres", show_centres ? 1 : 0);
    program.set("pixel_samples", sight.pixel_samples);
    // of a sphere at the middle of the picture; regions cover it twice, in front and behind
    const auto& projection = sight.view.clip_from_view;
    const float depth = sight.orthographic ? 1 : std::max(1.0f, glm::length(sight.view.eye_ws));
    const float radius_px =
        0.5f * static_cast<float>(height / sight.pixel_samples) * projection[1][1] / depth;
    program.set("mean_region_px", 2 * std::numbers::pi_v<float> * radius_px * radius_px /
                                      static_cast<float>(std::max<std::uint32_t>(1, plan.block.drawn)));
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

void LayerPainter::mark(const LayerPlan& plan, std::size_t index, const Sight& sight) {
    const auto selected = plan.wanted.selected;
    if (selected < 0 || static_cast<std::uint64_t>(selected) >= plan.drawn.elements) return;
    if (plan.primitive == Primitive::sphere) return;  // marked where its region is drawn
    const auto& gl = tools_.api;
    const auto& program = begin(plan, index, sight, {"passes/viewers/mark.vert", "passes/viewers/mark.frag"});
    const int segments = plan.primitive == Primitive::lines            ? 1
                         : plan.primitive == Primitive::parallelograms ? 4
                                                                       : 64;
    set_projection(program, sight);
    program.set("marked", static_cast<unsigned>(selected));
    program.set("segments", segments);
    const auto samples = static_cast<float>(sight.pixel_samples);
    program.set("ring_px", samples * (0.5f * plan.block.size_px + 5));
    const bool is_line = plan.primitive == Primitive::lines;
    if (is_line) program.bind_texture("colour_map", map_texture(plan.wanted.colour_map));
    const auto band = [&](float width_px, glm::vec3 colour, bool own_colour) {
        program.set("band_px", samples * width_px);
        program.set("mark_colour", colour);
        program.set("own_colour", own_colour ? 1 : 0);
        gl.DrawArrays(GL_TRIANGLES, 0, corners * segments);
    };
    const float own_px = is_line ? plan.block.size_px + 1 : 0;
    band(own_px + 5, glm::vec3(0), false);
    band(own_px + 2, glm::vec3(1), false);
    if (is_line) band(own_px - 1, glm::vec3(0), true);  // between white sides
}

}  // namespace ir::passes::viewers
