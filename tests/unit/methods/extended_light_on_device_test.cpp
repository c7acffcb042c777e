// Light samples by the device's body against the host's, which draws the same ones, and against the
// reference.
#include <map>

#include "renderers/passes/sampling/point_sequence.h"
#include "tests/unit/methods/extended_light_fixture.h"

namespace ir::test {
namespace {

class LightOnDeviceTest : public ExtendedLightTest {
  protected:
    void expect_both_agree(const Shot& shot, const passes::DirectLightOptions& options, int frames = 1) {
        const std::string keys[] = {"direct.extended.unfiltered", "direct.extended.variance", "direct.even",
                                    "direct.reflectance"};
        std::map<std::string, Image> device;
        body = Processor::gl;
        sampled(shot, options, frames);
        for (const auto& key : keys) device[key] = read(key);
        body = Processor::host;
        sampled(shot, options, frames);
        for (const auto& key : keys) {
            const auto difference = apart(device[key], read(key));
            EXPECT_LT(difference.part, 0.01) << key;
            EXPECT_NEAR(difference.ratio, 1, key.ends_with("variance") ? 0.05 : 2e-3) << key;
        }
    }
};

TEST_F(LightOnDeviceTest, RandomNumbersAreTheHosts) {
    constexpr std::uint32_t count = 1000;
    run(shot_of(Source::disk), [&](graph::GraphBuilder& builder) {
        const auto pairs = builder.buffer({.text = {.key = "pairs", .label = "Pairs"},
                                           .fields = {{"pair", FieldType::f32, 2}},
                                           .elements = count});
        builder.pass("pairs")
            .writes("Pairs", pairs)
            .compute({{SOURCE_ROOT "/tests/data/shaders/path_pairs.comp"}}, count);
    });
    const auto pairs = elements<glm::vec2>("pairs");
    ASSERT_EQ(pairs.size(), count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto key = passes::pixel_key(std::uint64_t{0xfffffff0u + i} << 32 | 7, i % 5, i) + i;
        ASSERT_EQ(pairs[i], passes::PathSampler(key, i / 3).pair(i % 3)) << i;
    }
}

TEST_F(LightOnDeviceTest, TheDeviceSamplesAsTheHostDoes) {
    for (const auto source : {Source::rectangle, Source::disk, Source::mesh, Source::constant, Source::map}) {
        SCOPED_TRACE(static_cast<int>(source));
        auto options = unfiltered(5);
        if (source == Source::disk) options.extended.materials = Transport::Materials::lambert;
        expect_both_agree(shot_of(source), options);
    }
}

/// Compiling programs takes most of the time, so one model has panes, and another has none.
TEST_F(LightOnDeviceTest, ClosedRoomsWithMirrorsAndPanesToo) {
    for (const bool has_pane : {true, false}) {
        SCOPED_TRACE(has_pane);
        auto scene = closed_room();
        if (!has_pane) scene.materials[4].transmission = 0;
        const Shot shot(std::move(scene), looking({0, 1.6f, 1.9f}, {0, 1, -1}), 32, 32);
        auto options = unfiltered(5);
        options.extended.materials =
            has_pane ? Transport::Materials::gltf : Transport::Materials::metalness_blend;
        options.extended.mirrors = true;
        expect_both_agree(shot, options, 2);
    }
}

TEST_F(LightOnDeviceTest, AndTreesOfManyTexturedSourcesWithHoles) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 2);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (int i = 0; i < 40; ++i)  // 80 triangles: groups within groups
        small.square({1.5f * unit(random), 1 + 0.6f * unit(random), 1.5f * unit(random)},
                     glm::normalize(glm::vec3(unit(random), unit(random), 0.5f)), 0.08f,
                     i % 2 == 0 ? SmallWorld::masked : static_cast<SmallWorld::Material>(2));
    auto scene = small.scene();
    scene.materials.resize(3);
    for (auto& material : scene.materials) material.metallic = 0;
    scene::Texture colours;
    colours.width = colours.height = 2;
    colours.rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255};
    scene.textures.push_back(colours);
    for (const std::size_t emitter : {1, 2}) {
        scene.materials[emitter].emission = glm::vec3(10);
        scene.materials[emitter].emission_texture.texture = 1;
    }
    expect_both_agree(shot_of(std::move(scene)), unfiltered(8));
}

/// More pixels than are sampled at once.
TEST_F(LightOnDeviceTest, LargePicturesAreSampledInBands) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 2);
    auto scene = small.scene();
    scene.materials[0].metallic = 0;
    scene::Light lamp;
    lamp.type = scene::LightType::rectangle;
    lamp.position = {0.3f, 1, 0.2f};
    lamp.direction = {0, -1, 0};
    lamp.size = {0.8f, 0.4f};
    scene.lights.push_back(lamp);
    const Shot shot(std::move(scene), looking({0, 1.3f, 3.2f}, {0, 0, 0}), 640, 420);
    static_assert(640 * 420 > 1 << 18);
    expect_both_agree(shot, unfiltered(1));
}

/// Wider than images of all devices may be.
TEST_F(LightOnDeviceTest, WideEnvironmentMapsAreSampledOnTheHostAndSaySo) {
    auto scene = room(Source::constant);
    scene.environment = {{}, std::make_shared<Image>(16385, 2, 3, 0.8f)};
    const auto shot = shot_of(std::move(scene));
    body = Processor::gl;
    const auto report = sample_anew(shot, unfiltered(4));
    EXPECT_TRUE(ran_on_host(report, "light samples"));
    EXPECT_TRUE(std::ranges::any_of(report.messages, [](const auto& message) {
        return message.text.find("16385 x 2 texels") != std::string::npos;
    }));
    const double wide = mean_of(read("direct.radiance"));
    sampled(shot_of(room(Source::constant)), unfiltered(4), 1);
    EXPECT_NEAR(wide / mean_of(read("direct.radiance")), 1, 0.03);
}

TEST_F(LightOnDeviceTest, EqualsTheReference) {
    auto scene = closed_room();
    scene.materials[2].roughness = 0.5f;  // samples leave mirrors out as the reference's direct light,
    scene.materials[4].transmission = 0;  // and its picture is seen through panes
    const Shot shot(std::move(scene), looking({0, 1.6f, 1.9f}, {0, 1, -1}), size, size);
    const auto expected = reference(shot, 256);
    body = Processor::gl;
    auto found = sampled(shot, unfiltered(16), 4);
    const auto emission = read("gbuffer.emission");
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) found.radiance.at(x, y) += emission.at(x, y);
    EXPECT_LT(largest_z(found, expected), 4);
    for (auto& value : found.radiance.pixels) value *= 1.05f;
    EXPECT_GT(largest_z(found, expected), 4) << "what is wrong by a twentieth is seen";
}

TEST_F(LightOnDeviceTest, NothingOfThePictureIsReadBack) {
    body = Processor::gl;
    const auto report = sample_anew(shot_of(Source::rectangle), unfiltered(4));
    for (const auto& pass : report.passes) {
        if (pass.queue == "cpu") {
            EXPECT_EQ(pass.name, "device BVH");
        }
    }
}

}  // namespace
}  // namespace ir::test
