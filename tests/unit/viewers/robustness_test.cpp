#include <random>

#include "tests/unit/viewers/viewer_fixture.h"

namespace ir::test {
namespace {

constexpr int tiny_width = 96, tiny_height = 64;

class RobustnessTest : public ViewerTest {
  protected:
    static std::vector<TestBuffer> one_of_each() {
        const Field normal{"normal", FieldType::f32, 3}, radius{"radius", FieldType::f32, 1},
            centre{"centre", FieldType::f32, 3}, u{"axis_u", FieldType::f32, 3},
            v{"axis_v", FieldType::f32, 3}, w{"axis_w", FieldType::f32, 3};
        return {{"points", OutputKind::point_set, {position_field, normal, {"kind", FieldType::i32, 1}}},
                {"lines", OutputKind::line_set, {{"start", FieldType::f32, 3}, {"end", FieldType::f32, 3}}},
                {"discs", OutputKind::glyphs, {centre, normal, radius}},
                {"boxes", OutputKind::glyphs, {centre, u, v}},
                {"balls", OutputKind::glyphs, {centre, u, v, w}},
                {"cells", OutputKind::sphere_values, {centre}},
                {"regions",
                 OutputKind::sphere_values,
                 {centre, {"colatitude", FieldType::f32, 2}, {"longitude", FieldType::f32, 2}}}};
    }
};

TEST_F(RobustnessTest, AnyBitsAreDrawnWithoutErrors) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(-3, 3);
    // bits at random (half of them far beyond any scene), among places in view, zeros, infinities
    const std::vector<std::uint32_t> special{0,           0x80000000u, 0x7f800000u, 0xff800000u,
                                             0x7fc00000u, 0xffffffffu, 1,           0x7f7fffffu};
    auto buffers = one_of_each();
    for (auto& buffer : buffers) {
        int stride = 0;
        for (const auto& field : buffer.fields) stride += field.count;
        for (int word = 0; word < 600 * stride; ++word) {
            const auto choice = random() % 8;
            if (choice == 0)
                buffer.add(static_cast<std::uint32_t>(random()));
            else if (choice == 1)
                buffer.add(special[random() % special.size()]);
            else
                buffer.add(unit(random));
        }
    }
    add_square({0, 0, 0}, {0, 0, 1}, 1);
    run(buffers);
    std::vector<Layer> layers;
    for (const auto& buffer : buffers)
        layers.push_back({.key = buffer.key, .colour_by = buffer.fields.back().name, .selected = 3});
    for (const bool orthographic : {false, true}) {
        camera_.orthographic = orthographic;
        for (const auto& layer : layers) {
            const auto picture = draw({layer}, tiny_width, tiny_height);
            EXPECT_EQ(picture.layers[0].note, "");
            const auto shown = std::count(picture.layer.begin(), picture.layer.end(), 0);
            EXPECT_GT(shown, 0) << layer.key;
            for (const float value : picture.colour.pixels) ASSERT_TRUE(value >= 0 && value <= 1) << value;
            for (const auto element : picture.element) ASSERT_LT(element, 600);
        }
        draw(layers, tiny_width, tiny_height);
    }
}

TEST_F(RobustnessTest, CamerasMayStandAnywhere) {
    add_square({0, 0, 0}, {0, 0, 1}, 1);
    auto buffers = one_of_each();
    buffers[0].add(glm::vec3(0, 0, 0.5), glm::vec3(0, 0, 1), 0);
    buffers[4].add(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1));
    run({buffers[0], buffers[4]});
    std::vector<scene::Camera> cameras(5, camera_);
    cameras[1].target = cameras[1].eye;
    cameras[2].eye = {0, 0, 0};
    cameras[2].target = {0, 3, 0};  // along up
    cameras[3].eye = {0, 0, 1e5f};
    cameras[4].fov_y = 0.001f;
    for (const auto& camera : cameras) {
        camera_ = camera;
        const auto picture = draw({{.key = "points", .selected = 0}, {.key = "balls", .selected = 0}},
                                  tiny_width, tiny_height);
        for (const float value : picture.colour.pixels) ASSERT_TRUE(value >= 0 && value <= 1) << value;
    }
}

TEST_F(RobustnessTest, TheWorldIsUploadedAgainWhenItChanges) {
    add_square({0, 0, 0}, {0, 0, 1}, 1);
    auto in = inputs();
    in.geometry_fingerprint = "first";
    Scene3D view{.width = tiny_width, .height = tiny_height};
    const auto first = viewer_->draw(graph(), in, camera_, view).colour.pixels;
    EXPECT_EQ(viewer_->draw(graph(), in, camera_, view).colour.pixels, first);
    add_square({1.2, 0, 1}, {0, 0, 1}, 0.4f);
    in = inputs();
    in.geometry_fingerprint = "second";
    EXPECT_NE(viewer_->draw(graph(), in, camera_, view).colour.pixels, first);
}

TEST_F(RobustnessTest, DrawsBetweenTheSlicesOfAFrame) {
    static constexpr int count = 64;
    const auto declare = [](graph::GraphBuilder& builder) {
        graph::BufferDesc desc;
        desc.text = {"points", "Points"};
        desc.kind = OutputKind::point_set;
        desc.fields = {position_field};
        desc.elements = count;
        const auto points = builder.buffer(desc);
        desc.text = {"copy", "Copy"};
        const auto copy = builder.buffer(desc);
        builder.pass("write", graph::Queue::cpu)
            .writes(points)
            .execute_sliced(
                count,
                [points](graph::PassContext& context, graph::Slice slice) {
                    const auto to = context.elements<glm::vec3>(points);
                    for (auto i = slice.begin; i < slice.end; ++i)
                        to[static_cast<std::size_t>(i)] = {0.02f * static_cast<float>(i) - 0.6f, 0, 0};
                },
                4);
        builder.pass("copy").reads(points).writes(copy).execute([points, copy](graph::PassContext& context) {
            context.api().CopyNamedBufferSubData(context.buffer(points), context.buffer(copy), 0, 0,
                                                 12 * count);
        });
    };
    graph::Method method;
    method.description.id = "test";
    method.setup = [&](graph::GraphBuilder& builder, const Settings&) { declare(builder); };
    graph::FrameOptions options;
    options.wanted = {"*"};
    int pictures = 0;
    options.between_slices = [&] {
        draw({{.key = "points"}}, tiny_width, tiny_height);
        ++pictures;
    };
    const auto in = inputs();
    graph().run(method, {}, in, options);
    EXPECT_GT(pictures, 0);
    const auto bytes = graph().read_buffer("copy");
    ASSERT_TRUE(bytes);
    std::vector<glm::vec3> copied(count);
    std::memcpy(copied.data(), bytes->data(), 12 * count);
    for (int i = 0; i < count; ++i)
        EXPECT_FLOAT_EQ(copied[static_cast<std::size_t>(i)].x, 0.02f * static_cast<float>(i) - 0.6f);
}

}  // namespace
}  // namespace ir::test
