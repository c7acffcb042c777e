#include "renderers/passes/preview/preview.h"

#include <algorithm>

#include "renderers/graph/pass_context.h"
#include "renderers/image/colour_map.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/scene/scene_buffers.h"

namespace ir::passes {
namespace {

using graph::PassContext;

/// Texels a side that stand for a texture.
constexpr int texels_queried = 8;

/// Mean of some texels of the base colour, linear.
glm::vec3 mean_colour(const scene::Scene& scene, const scene::Material& material) {
    const int index = material.base_colour_texture.texture;
    if (index < 0) return glm::vec3(1);
    const auto& texture = scene.textures.at(static_cast<std::size_t>(index));
    if (texture.width < 1 || texture.height < 1) return glm::vec3(1);
    glm::vec4 sum(0);
    for (int y = 0; y < texels_queried; ++y)
        for (int x = 0; x < texels_queried; ++x) {
            const auto row = static_cast<std::size_t>((2 * y + 1) * texture.height / (2 * texels_queried));
            const auto column = static_cast<std::size_t>((2 * x + 1) * texture.width / (2 * texels_queried));
            const auto* texel = &texture.rgba[4 * (row * static_cast<std::size_t>(texture.width) + column)];
            const float opacity = static_cast<float>(texel[3]) / 255 + 1e-3f;
            for (int c = 0; c < 3; ++c) {
                const float encoded = static_cast<float>(texel[c]) / 255;
                sum[c] += opacity * (texture.srgb ? linear_from_srgb(encoded) : encoded);
            }
            sum.w += opacity;
        }
    return glm::vec3(sum) / sum.w;
}

/// Constants of head_light.vert and head_light.frag.
struct HeadLight {
    glm::mat4 clip_from_world;
    Viewer viewer;
    glm::vec3 tint;
    int material_index;
    bool is_masked;
    IR_FIELDS(clip_from_world, viewer, tint, material_index, is_masked)
};

/// The scene's buffers as vertices of indexed triangles: each vertex is transformed once.
class Vertices {
  public:
    Vertices(const PassContext& context, const SceneBuffers& scene) : api_(context.api()) {
        api_.CreateVertexArrays(1, &name_);
        add(context.buffer(scene.positions), 3, GL_FLOAT, 12);
        add(context.buffer(scene.normals), 3, GL_FLOAT, 12);
        add(context.buffer(scene.colours), 4, GL_UNSIGNED_BYTE, 4);
        add(context.buffer(scene.uv0), 2, GL_FLOAT, 8);
        add(context.buffer(scene.uv1), 2, GL_FLOAT, 8);
        api_.VertexArrayElementBuffer(name_, context.buffer(scene.indices));
        api_.BindVertexArray(name_);
    }
    ~Vertices() {
        api_.BindVertexArray(0);
        api_.DeleteVertexArrays(1, &name_);
    }
    Vertices(const Vertices&) = delete;

  private:
    void add(gl::Name buffer, GLint count, GLenum type, GLsizei stride) {
        api_.EnableVertexArrayAttrib(name_, next_);
        api_.VertexArrayAttribFormat(name_, next_, count, type, type == GL_UNSIGNED_BYTE, 0);
        api_.VertexArrayAttribBinding(name_, next_, next_);
        api_.VertexArrayVertexBuffer(name_, next_, buffer, 0, stride);
        ++next_;
    }
    const gl::Api& api_;
    GLuint name_ = 0, next_ = 0;
};

void draw(const PassContext& p, const SceneBuffers& s, graph::ImageRef picture, graph::ImageRef depth) {
    const auto& gl = p.api();
    const auto& inputs = p.inputs();
    const PassContext::Attachment depths{depth};
    p.bind_framebuffer({{picture}}, &depths);
    const float none[4] = {0, 0, 0, 0}, far = 1;
    gl.ClearBufferfv(GL_COLOR, 0, none);
    gl.ClearBufferfv(GL_DEPTH, 0, &far);
    const auto& program = p.use({{"passes/preview/head_light.vert", "passes/preview/head_light.frag"}});
    const Vertices vertices(p, s);
    HeadLight constants{.clip_from_world = inputs.view.clip_from_world(),
                        .viewer = viewer(inputs.view),
                        .tint = {},
                        .material_index = 0,
                        .is_masked = false};
    gl.Enable(GL_DEPTH_TEST);
    for (const auto& range : inputs.world->ranges) {
        const auto& material = inputs.scene->materials.at(static_cast<std::size_t>(range.material));
        const auto shines = glm::min(material.emission, glm::vec3(1));
        constants.tint =
            glm::max(glm::vec3(material.base_colour) * mean_colour(*inputs.scene, material), shines);
        constants.material_index = range.material;
        constants.is_masked = range.first_triangle >= inputs.world->opaque_triangles;
        program.set(constants);
        gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * range.triangle_count), GL_UNSIGNED_INT,
                        reinterpret_cast<const void*>(12 * std::size_t{range.first_triangle}));
    }
    gl.Disable(GL_DEPTH_TEST);
}

void setup(graph::GraphBuilder& builder, const Settings&) {
    const auto scene = upload_scene(builder);
    const auto picture = builder.output("preview", {.format = gl::Format::rgba16f});
    const auto depth =
        builder.image({.text = {.key = "preview.depth", .label = "Depth"}, .format = gl::Format::depth32f});
    builder.pass("head light")
        .reads(scene.positions, scene.normals, scene.colours, scene.uv0, scene.uv1, scene.indices,
               scene.materials, scene.opacity, scene.opacity_words)
        .writes(picture, depth)
        .execute([=](PassContext& p) { draw(p, scene, picture, depth); });
}

}  // namespace

const graph::Method& preview() {
    static const graph::Method method{
        .description = {.id = "preview",
                        .title = "Preview",
                        .summary = "The surfaces under a light at the eye.",
                        .outputs = {{.key = "preview", .label = "Preview", .semantic = Semantic::albedo}}},
        .setup = setup};
    return method;
}

}  // namespace ir::passes
