#include "renderers/passes/viewers/draw.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/error.h"
#include "renderers/passes/viewers/layer_painter.h"
#include "renderers/passes/viewers/scene_mesh.h"

namespace ir::passes::viewers {
namespace {

/// Looks at the whole unit sphere, with a little air, from between +X and +Z and from above.
scene::Camera sphere_camera(int width, int height) {
    scene::Camera camera;
    camera.name = "sphere";
    camera.fov_y = 0.5f;
    const float narrowest = std::min(1.0f, static_cast<float>(width) / static_cast<float>(height));
    const float half_angle = std::atan(std::tan(0.5f * camera.fov_y) * narrowest);
    camera.eye = 1.06f / std::sin(half_angle) * glm::normalize(glm::vec3(0.55f, 0.6f, 1));
    return camera;
}

/// Looks along -Z at all of the bounds, with a little air.
scene::Camera framing_camera(const scene::Bounds& bounds, int width, int height) {
    scene::Camera camera;
    camera.name = "own space";
    const auto half = 0.5f * (bounds.max - bounds.min);
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    const float half_height = std::max({half.y, half.x / aspect, 1e-6f});
    camera.target = bounds.centre();
    camera.eye = camera.target;
    camera.eye.z += half.z + 1.06f * half_height / std::tan(0.5f * camera.fov_y);
    return camera;
}

/// What the rest of the house leaves behind does not matter, nor does it find anything of this.
void reset_state(const gl::Api& gl) {
    for (const GLenum capability :
         {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_RASTERIZER_DISCARD,
          GL_POLYGON_OFFSET_FILL, GL_MULTISAMPLE, GL_DEPTH_CLAMP, GL_PROGRAM_POINT_SIZE})
        gl.Disable(capability);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_TRUE);
    gl.DepthFunc(GL_LESS);
    gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

void unbind_all(const gl::Api& gl) {
    gl.UseProgram(0);
    gl.BindVertexArray(0);
}

bool has_primitive(const std::vector<LayerPlan>& plans, bool sphere) {
    return std::any_of(plans.begin(), plans.end(), [&](const auto& plan) {
        return plan.drawable && (plan.primitive == Primitive::sphere) == sphere;
    });
}

void include_unit_sphere(scene::Bounds& bounds) {
    const bool empty = bounds.empty();
    bounds.min = empty ? glm::vec3(-1) : glm::min(bounds.min, glm::vec3(-1));
    bounds.max = empty ? glm::vec3(1) : glm::max(bounds.max, glm::vec3(1));
}

}  // namespace

struct Viewer::State {
    State(gl::Context& context, gl::Device& device, gl::ProgramLibrary& programs)
        : context(context),
          tools{context.api(), device, programs},
          target(tools),
          mesh(tools),
          painter(tools) {}

    gl::Context& context;
    Tools tools;
    Target target;
    SceneMesh mesh;
    LayerPainter painter;

    void check_size(const Scene3D& view) const {
        const int limit = context.info().max_texture_size;
        if (view.width < 1 || view.height < 1 || view.width > limit || view.height > limit)
            throw UsageError(
                "a 3D view of " + std::to_string(view.width) + " × " + std::to_string(view.height) +
                " pixels cannot be drawn: both sides must be from 1 to " + std::to_string(limit));
    }

    /// As requested, as far as images can be so large.
    int oversampling(const Scene3D& view) const {
        const int limit = context.info().max_texture_size / std::max(view.width, view.height);
        return std::clamp(view.oversampling, 1, std::min(limit, 4));
    }

    std::vector<LayerPlan> plan(const graph::Graph& graph, const Scene3D& view) const {
        std::vector<LayerPlan> plans;
        for (const auto& layer : view.layers)
            plans.push_back(plan_layer(layer,
                                       view.after.empty() ? graph.device_buffer(layer.key)
                                                          : graph.device_buffer_after(view.after, layer.key),
                                       plans.size(), view.max_elements, tools.device.max_buffer_bytes()));
        keep_spaces_apart(plans);
        return plans;
    }

    void paint(const std::vector<LayerPlan>& plans, const Sight& sight, bool show_centres) {
        const auto& gl = tools.api;
        for (std::size_t i = 0; i < plans.size(); ++i)
            if (plans[i].drawable && !plans[i].is_translucent())
                painter.draw(plans[i], i, sight, target, show_centres);
        if (std::any_of(plans.begin(), plans.end(), [](const auto& plan) { return plan.is_translucent(); }))
            painter.draw_translucent(plans, sight, target);
        gl.Disable(GL_DEPTH_TEST);
        gl.ColorMaski(1, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        for (std::size_t i = 0; i < plans.size(); ++i)
            if (plans[i].drawable) painter.mark(plans[i], i, sight);
        gl.ColorMaski(1, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }
};

Viewer::Viewer(gl::Context& context, gl::Device& device, gl::ProgramLibrary& programs)
    : state_(std::make_unique<State>(context, device, programs)) {}

Viewer::~Viewer() = default;

Picture3D Viewer::draw(graph::Graph& graph, const graph::FrameInputs& inputs, const scene::Camera& camera,
                       const Scene3D& view) {
    auto& s = *state_;
    s.check_size(view);
    const auto& gl = s.tools.api;
    auto plans = s.plan(graph, view);
    const bool only_spheres = has_primitive(plans, true) && !has_primitive(plans, false);
    const bool own_space = std::any_of(plans.begin(), plans.end(),
                                       [](const auto& plan) { return plan.drawable && plan.has_own_space; });
    const bool has_scene = inputs.world && !only_spheres && !own_space;
    const bool show_scene = view.show_scene && has_scene;
    Picture3D picture;
    picture.camera = view.camera.value_or(only_spheres ? sphere_camera(view.width, view.height) : camera);

    scene::Bounds bounds;
    if (has_scene) bounds = inputs.world->bounds;
    if (has_primitive(plans, true)) include_unit_sphere(bounds);
    reset_state(gl);
    s.painter.measure(plans, make_sight(picture.camera, view.width, view.height, 1, bounds), bounds);
    if (own_space && !view.camera && !bounds.empty())
        picture.camera = framing_camera(bounds, view.width, view.height);
    const int oversampling = s.oversampling(view);
    const auto sight = make_sight(picture.camera, view.width, view.height, oversampling, bounds);

    s.target.begin(view.width, view.height, oversampling);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LEQUAL);
    // What is nearer than the near plane or far off is drawn, too; what an orthographic camera has behind it
    // is not.
    if (!sight.orthographic) gl.Enable(GL_DEPTH_CLAMP);
    if (show_scene) s.mesh.draw(graph, inputs, sight);
    s.paint(plans, sight, view.show_centres);
    s.target.end();
    reset_state(gl);
    unbind_all(gl);
    s.target.read(picture);
    for (auto& plan : plans) picture.layers.push_back(std::move(plan.drawn));
    return picture;
}

}  // namespace ir::passes::viewers
