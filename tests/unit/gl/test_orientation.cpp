#include "context_fixture.h"
#include "renderers/gl/device.h"
#include "renderers/gl/program.h"

namespace ir::gl {
namespace {

constexpr int size = 8;
constexpr const char* vertex_shader =
    "uniform float depth;\n"
    "void main() {\n"
    "    vec2 corners[3] = vec2[3](vec2(-1, 0), vec2(3, 0), vec2(-1, 4));\n"  // y > 0 and all x
    "    gl_Position = vec4(corners[gl_VertexID], depth, 1);\n"
    "}\n";

class OrientationTest : public ContextTest {
  protected:
    void SetUp() override {
        ContextTest::SetUp();
        device = make_gl_device(*context);
        folder.write("upper_half.vert", vertex_shader);
        folder.write("place.frag",
                     "layout(location = 0) out vec4 place;\n"
                     "void main() { place = vec4(gl_FragCoord.xyz, 1); }\n");
        colour = device->create_image(colour_shape, "colour");
        depth = device->create_image(depth_shape, "depth");
        device->clear_image(colour, colour_shape);
        device->clear_image(depth, depth_shape);
    }
    void TearDown() override {
        device.reset();
        ContextTest::TearDown();
    }

    void draw(float at_depth) {
        GLuint framebuffer = 0, vertices = 0;
        api().CreateFramebuffers(1, &framebuffer);
        api().NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, colour, 0);
        api().NamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, depth, 0);
        ASSERT_EQ(api().CheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER),
                  static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
        api().CreateVertexArrays(1, &vertices);
        api().BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        api().BindVertexArray(vertices);
        api().Viewport(0, 0, size, size);
        api().Enable(GL_DEPTH_TEST);
        ProgramLibrary library(*context, folder.path());
        const auto& program = library.get({{"upper_half.vert", "place.frag"}});
        struct Place {
            float depth;
            IR_FIELDS(depth)
        };
        program.set(Place{at_depth});
        program.use();
        api().DrawArrays(GL_TRIANGLES, 0, 3);
        api().BindFramebuffer(GL_FRAMEBUFFER, 0);
        api().DeleteFramebuffers(1, &framebuffer);
        api().DeleteVertexArrays(1, &vertices);
    }

    ImageShape colour_shape{size, size, 1, 0, Format::rgba32f};
    ImageShape depth_shape{size, size, 1, 0, Format::depth32f};
    ShaderFolder folder;
    std::unique_ptr<Device> device;
    Name colour = 0, depth = 0;
};
INSTANTIATE_ON_BOTH_BACKENDS(OrientationTest);

TEST_P(OrientationTest, RowZeroIsTheTopAndDepthIsZeroToOne) {
    draw(0.25f);
    std::vector<glm::vec4> places(size * size);
    std::vector<float> depths(size * size);
    device->read_image(colour, colour_shape, 0, 0, std::as_writable_bytes(std::span(places)));
    device->read_image(depth, depth_shape, 0, 0, std::as_writable_bytes(std::span(depths)));
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const auto i = static_cast<std::size_t>(y * size + x);
            const bool covered = y < size / 2;  // y_ndc > 0
            const glm::vec4 place(x + 0.5f, y + 0.5f, 0.25f, 1);
            EXPECT_EQ(places[i], covered ? place : glm::vec4(0)) << x << " " << y;
            EXPECT_EQ(depths[i], covered ? 0.25f : 1.0f) << x << " " << y;
        }
    }
}

TEST_P(OrientationTest, ClipsInFrontOfDepthZero) {
    draw(-0.25f);  // inside of OpenGL's own range -1…1
    std::vector<float> depths(size * size);
    device->read_image(depth, depth_shape, 0, 0, std::as_writable_bytes(std::span(depths)));
    for (const float value : depths) EXPECT_EQ(value, 1.0f);
}

}  // namespace
}  // namespace ir::gl
