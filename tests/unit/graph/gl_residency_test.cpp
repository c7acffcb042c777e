#include "tests/unit/graph/gl_graph_fixture.h"

namespace ir::graph {
namespace {

const char* const double_program = R"(
layout(local_size_x = 8) in;
layout(std430) buffer Numbers { uint numbers[]; };
layout(std430) buffer Count { uint count; };
layout(r32f) uniform image2D picture;
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(numbers.length())) return;
    numbers[i] *= 2u;
    atomicAdd(count, 1u);
    if (i < 4u) {
        float before = imageLoad(picture, ivec2(i, 0)).x;
        imageStore(picture, ivec2(i, 0), vec4(before + 0.5));
    }
}
)";

/// The graph over real OpenGL, with a program that doubles numbers and adds ½ to pixels.
class GlGraphTest : public GlGraphFixture {
  protected:
    void SetUp() override {
        GlGraphFixture::SetUp();
        folder.write("double.comp", double_program);
        inputs.view.width = 4;
        inputs.view.height = 2;
    }
    static void run_double(const PassContext& p, BufferRef numbers) {
        const auto& program = p.use({{"double.comp"}});
        program.dispatch(static_cast<std::int64_t>(p.capacity(numbers)));
    }
};

TEST_P(GlGraphTest, ContentsGoFromHostToDeviceAndBack) {
    std::vector<std::uint32_t> seen;
    std::vector<float> pixels;
    const auto report = run([&](GraphBuilder& builder) {
        const auto numbers = builder.buffer(buffer_of("numbers", 10));
        const auto picture = builder.image(image_of("picture"));
        const auto end = builder.image(image_of("end"));
        const auto count = builder.counter({.key = "doubled", .label = ""});
        builder.pass("host", Queue::cpu).writes(numbers, picture).counts(count).execute([=](PassContext& p) {
            std::uint32_t next = 1;
            for (auto& x : p.elements<std::uint32_t>(numbers)) x = next++;
            for (auto& x : p.pixels<float>(picture)) x = 7;
            p.add(count, 100);
        });
        for (const char* name : {"device", "device again"})
            builder.pass(name)
                .writes("Numbers", numbers)
                .writes("picture", picture)
                .counts("Count", count)
                .execute([=](PassContext& p) { run_double(p, numbers); });
        builder.pass("host again", Queue::cpu)
            .reads(numbers, picture)
            .writes(end)
            .execute([=, &seen, &pixels](PassContext& p) {
                const auto n = p.elements<std::uint32_t>(numbers);
                const auto x = p.pixels<float>(picture);
                seen.assign(n.begin(), n.end());
                pixels.assign(x.begin(), x.end());
            });
    });
    EXPECT_EQ(seen, (std::vector<std::uint32_t>{4, 8, 12, 16, 20, 24, 28, 32, 36, 40}));
    EXPECT_EQ(pixels, (std::vector<float>{8, 8, 8, 8, 7, 7, 7, 7}));
    EXPECT_EQ(report.counters.at("doubled"), 120);
    EXPECT_EQ(graph->read_image("picture")->at(2, 0, 0), 8);
    EXPECT_EQ(report.backend, gl::to_string(GetParam()));
}

TEST_P(GlGraphTest, HistoryOnTheDeviceStartsWithZeros) {
    const Declare declare = [](GraphBuilder& builder) {
        const auto sum = builder.image(image_of("sum"));
        const auto numbers = builder.buffer(buffer_of("numbers", 4));
        const auto seen = builder.image(image_of("seen"));
        builder.pass("add").reads_previous(sum, numbers).writes(sum, numbers).execute([=](PassContext& p) {
            const auto& gl = p.api();
            gl.CopyImageSubData(p.previous(sum), GL_TEXTURE_2D, 0, 0, 0, 0, p.image(sum), GL_TEXTURE_2D, 0, 0,
                                0, 0, 4, 2, 1);
            gl.CopyNamedBufferSubData(p.previous(numbers), p.buffer(numbers), 0, 0, 16);
        });
        builder.pass("one more", Queue::cpu).writes(sum, numbers, seen).execute([=](PassContext& p) {
            for (auto& x : p.pixels<float>(sum)) x += 1;
            for (auto& x : p.elements<std::uint32_t>(numbers)) x += 1;
            EXPECT_FALSE(p.has_previous());  // it reads none itself
        });
    };
    for (int i = 1; i <= 3; ++i) {
        run(declare);
        EXPECT_EQ(graph->read_image("sum")->at(3, 1, 0), static_cast<float>(i));
        EXPECT_EQ(as<std::uint32_t>(*graph->read_buffer("numbers"))[3], static_cast<std::uint32_t>(i));
    }
    graph->reset_history();
    run(declare);
    EXPECT_EQ(graph->read_image("sum")->at(3, 1, 0), 1);
}

TEST_P(GlGraphTest, ManyFailingPassesLeaveTheContextUsable) {
    const auto failing = [](GraphBuilder& builder) {
        const auto image = builder.image(image_of("image"));
        builder.pass("fail").writes(image).execute([=](PassContext& p) {
            p.bind_framebuffer({{image}});
            throw Error("no");
        });
    };
    // A debug group left open each time would overflow the driver's stack of 64.
    for (int i = 0; i < 70; ++i) EXPECT_THROW(run(failing), Error);
}

INSTANTIATE_ON_BOTH_BACKENDS(GlGraphTest);

}  // namespace
}  // namespace ir::graph
