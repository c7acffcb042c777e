#include "tests/unit/graph/gl_graph_fixture.h"

namespace ir::graph {
namespace {

const char* const paint_program = R"(
layout(local_size_x = 8, local_size_y = 8) in;
layout(r32f) readonly uniform image2D before;
layout(r32f) uniform image2D picture;
void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, imageSize(picture)))) return;
    float noise = fract(sin(float(p.x) * 12.9898 + float(p.y) * 78.233) * 43758.5453);
    imageStore(picture, p, vec4(imageLoad(before, p).x * 0.5 + noise));
}
)";

const char* const explain_program = R"(
layout(local_size_x = 1) in;
layout(r32f) readonly uniform image2D picture;
layout(r32f) readonly uniform image2D before;
layout(std430) buffer Why { float why[]; };
uniform ivec2 pixel;
void main() {
    why[0] = imageLoad(picture, pixel).x;
    why[1] = imageLoad(before, pixel).x;
}
)";

/// Over real OpenGL: a picture with a history, and an explanation of one pixel of it.
class GlExplainTest : public GlGraphFixture {
  protected:
    void SetUp() override {
        GlGraphFixture::SetUp();
        folder.write("paint.comp", paint_program);
        folder.write("explain.comp", explain_program);
        inputs.view.width = 13;
        inputs.view.height = 9;
        inputs.inspection.x = inputs.inspection.y = 3;
        options.wanted = {"why"};
        method.description.outputs = {
            {.key = "picture", .label = "picture"},
            {.key = "why", .label = "why", .kind = OutputKind::table, .explains = true}};
        method.setup = [](GraphBuilder& builder, const Settings&) { declare(builder); };
    }

    static void declare(GraphBuilder& builder) {
        const auto picture = builder.image(image_of("picture"));
        const auto before = builder.image(image_of("before"));
        const auto why = builder.buffer(buffer_of("why", 2, FieldType::f32));
        builder.pass("copy").reads_previous(picture).writes(before).execute([=](PassContext& p) {
            const auto size = p.shape(picture);
            p.api().CopyImageSubData(p.previous(picture), GL_TEXTURE_2D, 0, 0, 0, 0, p.image(before),
                                     GL_TEXTURE_2D, 0, 0, 0, 0, size.width, size.height, 1);
        });
        builder.pass("paint").reads("before", before).writes("picture", picture).execute([=](PassContext& p) {
            const auto& program = p.use({{"paint.comp"}});
            program.dispatch(p.shape(picture).width, p.shape(picture).height);
        });
        auto explain = builder.pass("explain");
        struct Explain {
            glm::ivec2 pixel;
            IR_FIELDS(pixel)
        };
        const auto& picked = builder.inputs().inspection;
        explain.reads("picture", picture).reads("before", before).writes("Why", why);
        explain.compute({{"explain.comp"}}, 1, Explain{{picked.x, picked.y}});
    }
    static FrameReport run(Graph& graph, const Method& method, FrameInputs& inputs,
                           const FrameOptions& options) {
        auto report = graph.run(method, {}, inputs, options);
        ++inputs.frame;
        return report;
    }
    std::vector<float> why_of(const Graph& from) const { return as<float>(from.read_buffer("why").value()); }
    Method method;
};

TEST_P(GlExplainTest, ThePictureIsBitEqualAndTheExplanationAsInAFreshRun) {
    for (int i = 0; i < 3; ++i) run(*graph, method, inputs, options);
    const auto picture = graph->read_image("picture").value();
    for (const auto& [x, y] : {std::pair{12, 8}, {0, 0}, {5, 7}}) {
        inputs.inspection.x = x;
        inputs.inspection.y = y;
        ASSERT_TRUE(graph->explain(method, {}, inputs, options));
        EXPECT_EQ(graph->read_image("picture")->pixels, picture.pixels);
        EXPECT_EQ(why_of(*graph)[0], picture.at(x, y, 0));

        Graph other(*device, context.get(), programs.get());
        auto again = inputs;
        again.frame = 0;
        for (int i = 0; i < 3; ++i) run(other, method, again, options);
        EXPECT_EQ(why_of(other), why_of(*graph));
    }
    // The next frame builds on the same history.
    run(*graph, method, inputs, options);
    Graph other(*device, context.get(), programs.get());
    auto again = inputs;
    again.frame = 0;
    for (int i = 0; i < 4; ++i) run(other, method, again, options);
    EXPECT_EQ(graph->read_image("picture")->pixels, other.read_image("picture")->pixels);
}

TEST_P(GlExplainTest, TexelsAreThoseOfTheImage) {
    run(*graph, method, inputs, options);
    const auto picture = graph->read_image("picture").value();
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 13; ++x)
            ASSERT_EQ(graph->read_texel("picture", x, y), std::vector<float>{picture.at(x, y, 0)});
    EXPECT_FALSE(graph->read_texel("picture", 13, 0));
    EXPECT_FALSE(graph->read_texel("picture", 0, -1));
    EXPECT_FALSE(graph->read_texel("picture", 0, 0, 1));
    EXPECT_FALSE(graph->read_texel("why", 0, 0));
}

INSTANTIATE_ON_BOTH_BACKENDS(GlExplainTest);

}  // namespace
}  // namespace ir::graph
