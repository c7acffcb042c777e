#include <cmath>

#include "renderers/core/constants.h"
#include "renderers/passes/scattering/bsdf.h"
#include "tests/unit/methods/photon_mapping_filtering_fixture.h"

namespace ir::test {
namespace {

using Materials = Transport::Materials;
using Paths = Transport::Paths;

constexpr int compose_size = 24;

/// A square z = 0 whose vertex normals lean by `tilt` towards +x, with a material of the test.
SmallWorld square(float tilt, const scene::Material& material) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 1);
    auto& scene = const_cast<scene::Scene&>(small.scene());
    scene.meshes[0].normals.assign(4, {std::sin(tilt), 0, std::cos(tilt)});
    scene.materials[0] = material;
    return small;
}

scene::Material grey() {
    scene::Material material;
    material.base_colour = {0.5f, 0.4f, 0.8f, 1};
    material.metallic = 0.25f, material.roughness = 0.6f;
    return material;
}

Shot seen(const SmallWorld& small) {
    return {small.scene(), looking({0, 0, 4}, {0, 0, 0}), compose_size, compose_size};
}

/// E = 1, 2, 3 from `direction`, as photons of one direction leave it.
Estimate light_from(glm::vec3 direction) {
    const auto sum = 6.0f * glm::normalize(direction);
    auto e = Estimate::constant(compose_size, compose_size, {1, 2, 3, sum.x});
    e.direction.assign(e.size(), {sum.y, sum.z});
    return e;
}

class ComposeTest : public FilteringTest {
  protected:
    static pm::Parameters parameters(Paths paths, Materials materials = Materials::lambert) {
        auto p = spatial(0, 0);
        p.transport.paths = paths;
        p.transport.materials = materials;
        return p;
    }
    FrameReport compose(const Shot& shot, const Estimate& estimate, const pm::Parameters& p) {
        return run(shot, [&](graph::GraphBuilder& builder) {
            const auto scene = passes::upload_scene(builder);
            const auto gbuffer = passes::gbuffer(builder, scene);
            const auto filtered = pm::filter_irradiance(builder, gbuffer, declare(builder, estimate), p);
            pm::compose(builder, scene, gbuffer, filtered, p);
        });
    }
    glm::vec3 middle(const std::string& key) const {
        return rgb(read(key), compose_size / 2, compose_size / 2);
    }
};

TEST_F(ComposeTest, IndirectLightIsReflectedByTheDiffusePartOfEachModel) {
    const auto material = grey();
    const auto shot = seen(square(0, material));
    const glm::vec3 e(1, 2, 3), base(material.base_colour);
    const auto expect = [&](Materials materials, glm::vec3 reflectance) {
        auto p = parameters(Paths::indirect, materials);
        p.receivers.receiver = passes::Receiver::diffuse;
        compose(shot, light_from({0, 0, 1}), p);
        EXPECT_LT(glm::distance(middle("radiance"), reflectance * e / ir::pi), 1e-3f);
        EXPECT_LT(glm::distance(middle("irradiance"), e), 2e-3f);
        EXPECT_EQ(rgb(read("radiance"), 0, 0), glm::vec3(0));
        EXPECT_EQ(rgb(read("irradiance"), 0, 0), glm::vec3(0));
    };
    expect(Materials::lambert, base);
    expect(Materials::metalness_blend, 0.75f * base);
    const auto f0 = glm::mix(glm::vec3(0.04f), base, 0.25f);  // the light comes from where the eye is
    expect(Materials::gltf, 0.75f * base * (1.0f - f0));
}

class ReceiverTest : public ComposeTest {
  protected:
    static constexpr float roughness = 0.5f;
    static scene::Material metal() {
        auto material = grey();
        material.metallic = 1;
        material.roughness = roughness;
        return material;
    }
    /// Of the estimate, whose mean direction is `length` long.
    glm::vec3 reflected(const Shot& shot, Materials materials, passes::Receiver receiver, glm::vec3 l,
                        float length) {
        auto estimate = light_from(l);
        for (auto& value : estimate.value) value.a *= length;
        for (auto& d : estimate.direction) d *= length;
        auto p = parameters(Paths::indirect, materials);
        p.receivers.receiver = receiver;
        compose(shot, estimate, p);
        return middle("radiance");
    }
    passes::Bsdf bsdf(Materials materials) const {
        passes::Surface surface;
        surface.geometric_normal_ws = surface.shading_normal_ws = {0, 0, 1};
        surface.base_colour = glm::vec3(metal().base_colour);
        surface.metallic = 1;
        surface.roughness = roughness;
        return {surface, material_, materials};
    }
    glm::vec3 to_viewer(const Shot& shot) const {
        return glm::normalize(shot.view.eye_ws -
                              rgb(read("gbuffer.position"), compose_size / 2, compose_size / 2));
    }

  private:
    scene::Material material_ = metal();
};

TEST_F(ReceiverTest, MeanDirectionsLightTheWholeBrdf) {
    const auto shot = seen(square(0, metal()));
    const auto l = glm::normalize(glm::vec3(0.15f, -0.1f, 1));
    for (const auto materials : {Materials::gltf, Materials::metalness_blend})
        for (const float length : {1.0f, 0.5f}) {
            const auto found = reflected(shot, materials, passes::Receiver::mean_direction, l, length);
            const auto expected = bsdf(materials).evaluate(to_viewer(shot), l) * glm::vec3(1, 2, 3) / l.z;
            EXPECT_LT(glm::distance(found, expected), 5e-3f * glm::length(expected)) << length;
        }
}

/// The mean of directions from everywhere, by the cosine, is 2/3 long: the same radiance E/π from all of
/// them. The formula for the directional albedo is good to a tenth.
TEST_F(ReceiverTest, WidenedOnesReflectLightFromEverywhereByTheirAlbedo) {
    for (const float x : {0.0f, 2.0f, 5.0f}) {
        const Shot shot{square(0, metal()).scene(), looking({x, 0, 3}, {0, 0, 0}), compose_size,
                        compose_size};
        const auto found = reflected(shot, Materials::gltf, passes::Receiver::widened, {0, 0, 1}, 2.0f / 3);
        glm::dvec3 albedo(0);
        const int n = 20'000;
        for (int i = 0; i < n; ++i) {
            const float u = (static_cast<float>(i) + 0.5f) / n,
                        v = std::fmod(0.618034f * static_cast<float>(i), 1.0f);
            if (const auto s = bsdf(Materials::gltf).sample(to_viewer(shot), 0.5f, {u, v}))
                albedo += s->weight;
        }
        const auto expected = glm::vec3(albedo / double(n)) * glm::vec3(1, 2, 3) / ir::pi;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / expected[c], 1, 0.1) << x << " channel " << c;
    }
}

/// Narrow light: nearly what its mean direction gives, and less beside the mirrored view than a lobe of the
/// interface alone would allow.
TEST_F(ReceiverTest, WidenedOnesReflectNarrowLightAsTheBrdfDoes) {
    const auto shot = seen(square(0, metal()));
    for (const float lean : {0.0f, 0.3f, 0.6f}) {
        const auto l = glm::normalize(glm::vec3(lean, 0, 1));
        const auto narrow = reflected(shot, Materials::gltf, passes::Receiver::widened, l, 0.999f);
        const auto mean = reflected(shot, Materials::gltf, passes::Receiver::mean_direction, l, 1);
        EXPECT_NEAR(narrow.g / mean.g, 1, 0.4) << lean << ": lobes have broader shoulders";
    }
    const auto spread = reflected(shot, Materials::gltf, passes::Receiver::widened, {0, 0, 1}, 0.8f);
    const auto peak = reflected(shot, Materials::gltf, passes::Receiver::mean_direction, {0, 0, 1}, 1);
    EXPECT_LT(spread.g, 0.8f * peak.g);
}

/// What has no interface is the same to all receivers.
TEST_F(ComposeTest, LambertReceiversHaveNoHighlights) {
    const auto shot = seen(square(0, grey()));
    auto p = parameters(Paths::indirect);
    compose(shot, light_from({0, 0, 1}), p);
    const auto widened = middle("radiance");
    p.receivers.receiver = passes::Receiver::diffuse;
    compose(shot, light_from({0, 0, 1}), p);
    EXPECT_EQ(middle("radiance"), widened);
}

TEST_F(ComposeTest, TheDirectionalTermTurnsTheCosineToTheShadingNormal) {
    const float tilt = 0.4f;
    const auto shot = seen(square(tilt, grey()));
    const glm::vec3 geometric(0, 0, 1), shading(std::sin(tilt), 0, std::cos(tilt));
    auto p = parameters(Paths::indirect);
    for (const float angle : {-0.9f, -0.3f, 0.0f, 0.6f, 1.1f}) {
        const glm::vec3 l(std::sin(angle), 0, std::cos(angle));
        compose(shot, light_from(l), p);
        const float factor = glm::dot(l, shading) / glm::dot(l, geometric);
        EXPECT_LT(glm::distance(middle("irradiance"), factor * glm::vec3(1, 2, 3)), 1e-2f) << angle;
        // eq. 7.10 has the normals in each other's place
        const float printed = glm::dot(l, geometric) / glm::dot(l, shading);
        EXPECT_GT(glm::distance(middle("irradiance"), printed * glm::vec3(1, 2, 3)), 0.1f)
            << "the mutant passes at " << angle;
    }
    p.receivers.directional = false;
    compose(shot, light_from({1, 0, 1}), p);
    EXPECT_LT(glm::distance(middle("irradiance"), {1, 2, 3}), 1e-6f);
}

TEST_F(ComposeTest, TheDirectionalTermLeavesFlatSurfacesAloneAndIsBounded) {
    const auto flat = seen(square(0, grey())), tilted = seen(square(0.4f, grey()));
    auto p = parameters(Paths::indirect);
    for (const float angle : {0.0f, 1.0f, 1.4f, 1.6f}) {
        compose(flat, light_from({std::sin(angle), 0, std::cos(angle)}), p);
        EXPECT_LT(glm::distance(middle("irradiance"), {1, 2, 3}), 1e-4f) << angle;
    }
    compose(tilted, light_from({1, 0, 1e-3f}), p);
    EXPECT_LT(middle("irradiance").r, 1 + p.max_stretch);
    EXPECT_GT(middle("irradiance").r, 1);
    compose(tilted, light_from({-1, 0, 1e-3f}), p);
    EXPECT_EQ(middle("irradiance"), glm::vec3(0)) << "behind the shading normal";
    compose(tilted, Estimate::constant(compose_size, compose_size, {1, 2, 3, 0}), p);
    auto unknown = Estimate::constant(compose_size, compose_size, {1, 2, 3, 0});
    unknown.direction.assign(unknown.size(), glm::vec2(0));
    compose(tilted, unknown, p);
    EXPECT_EQ(middle("irradiance"), glm::vec3(1, 2, 3)) << "no direction is known";
}

TEST_F(ComposeTest, FullAddsDirectLightEmissionAndTheEnvironment) {
    auto material = grey();
    material.emission = {0.5f, 0, 0.25f};
    auto small = square(0, material);
    auto& scene = const_cast<scene::Scene&>(small.scene());
    scene.environment.constant = {0.1f, 0.2f, 0.3f};
    scene::Light sun;
    sun.type = scene::LightType::directional;
    sun.direction = {0, 0, -1};
    scene.lights.push_back(sun);
    const auto shot = seen(small);
    const auto estimate = light_from({0, 0, 1});
    compose(shot, estimate, parameters(Paths::indirect));
    const auto indirect = middle("radiance");
    compose(shot, estimate, parameters(Paths::direct));
    const auto direct = middle("radiance");
    EXPECT_GT(direct.r, 0);
    EXPECT_EQ(rgb(read("radiance"), 0, 0), glm::vec3(0));
    auto full = parameters(Paths::full);
    compose(shot, estimate, full);
    EXPECT_LT(glm::distance(middle("radiance"), indirect + direct + material.emission), 1e-3f);
    EXPECT_LT(glm::distance(rgb(read("radiance"), 0, 0), scene.environment.constant), 1e-6f);
    full.transport.environment_light = false;
    compose(shot, estimate, full);
    EXPECT_EQ(rgb(read("radiance"), 0, 0), glm::vec3(0));
}

TEST_F(ComposeTest, DirectLightFollowsTheMaterialModel) {
    auto material = grey();
    material.metallic = 0.6f;
    const auto small = square(0, material);
    scene::Light sun;
    sun.type = scene::LightType::directional;
    sun.direction = glm::normalize(glm::vec3(-1, 0.3f, -1));
    const_cast<scene::Scene&>(small.scene()).lights.push_back(sun);
    const auto shot = seen(small);
    const auto l = -sun.direction;
    const float across = l.z;
    std::vector<glm::vec3> found;
    for (const auto materials : {Materials::gltf, Materials::metalness_blend, Materials::lambert}) {
        compose(shot, light_from({0, 0, 1}), parameters(Paths::direct, materials));
        const auto position = rgb(read("gbuffer.position"), compose_size / 2, compose_size / 2);
        passes::Surface surface;
        surface.geometric_normal_ws = surface.shading_normal_ws = {0, 0, 1};
        surface.base_colour = glm::vec3(material.base_colour);
        surface.metallic = material.metallic, surface.roughness = material.roughness;
        const auto v = glm::normalize(glm::vec3(0, 0, 4) - position);
        const auto f = passes::Bsdf(surface, material, materials).evaluate(v, l);
        compose(shot, light_from({0, 0, 1}), parameters(Paths::direct, Materials::lambert));
        const auto irradiance = middle("radiance") * ir::pi / surface.base_colour / across;
        EXPECT_LT(glm::distance(irradiance, glm::vec3(1)), 2e-3f);
        compose(shot, light_from({0, 0, 1}), parameters(Paths::direct, materials));
        EXPECT_LT(glm::distance(middle("radiance"), f * irradiance), 2e-3f * glm::length(f * irradiance));
        found.push_back(middle("radiance"));
    }
    EXPECT_GT(glm::distance(found[0], found[1]), 1e-3f);
    EXPECT_GT(glm::distance(found[1], found[2]), 1e-3f);
}

TEST_F(ComposeTest, TheSpreadOfDirectionsIsOneMinusTheirMeansLength) {
    const auto shot = seen(square(0, grey()));
    auto estimate = light_from({0, 0, 1});
    compose(shot, estimate, parameters(Paths::indirect));
    EXPECT_NEAR(read("history.flicker").at(compose_size / 2, compose_size / 2), 0, 1e-6f);
    for (auto& d : estimate.direction) d *= 0.25f;
    compose(shot, estimate, parameters(Paths::indirect));
    EXPECT_NEAR(read("history.flicker").at(compose_size / 2, compose_size / 2), 0.75f, 1e-6f);
}

TEST_F(ComposeTest, NamesInOutputsAndStagesExist) {
    const auto shot = seen(square(0, grey()));
    auto p = parameters(Paths::full);
    p.filter_passes = 6, p.temporal = true;
    compose(shot, light_from({0, 0, 1}), p);
    for (const auto& output : pm::filtering_outputs()) EXPECT_FALSE(read(output.key).empty()) << output.key;
    for (const auto& stage : pm::filtering_stages())
        EXPECT_FALSE(read(stage.output, stage.layer).empty()) << stage.output << stage.layer;
}

}  // namespace
}  // namespace ir::test
