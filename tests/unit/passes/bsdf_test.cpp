#include "renderers/passes/scattering/bsdf.h"

#include "renderers/passes/scattering/microfacets.h"
#include "tests/unit/gl/shader_lib_fixture.h"
#include "tests/unit/passes/bsdf_fixture.h"

namespace ir::test {
namespace {

constexpr Materials models[] = {Materials::gltf, Materials::metalness_blend, Materials::lambert};

TEST(Bsdf, IsReciprocal) {
    std::mt19937 random(1);
    for (const auto model : models)
        for (const float roughness : {0.2f, 0.5f, 1.0f})
            for (const float metallic : {0.0f, 0.3f, 1.0f}) {
                Patch patch(model);
                patch.surface.roughness = roughness;
                patch.surface.metallic = metallic;
                const auto bsdf = patch.bsdf();
                const auto n = patch.surface.shading_normal_ws;
                for (int i = 0; i < 200; ++i) {
                    const auto a = random_hemisphere(patch, random), b = random_hemisphere(patch, random);
                    const auto ab = bsdf.evaluate(a, b) / glm::dot(n, b);
                    const auto ba = bsdf.evaluate(b, a) / glm::dot(n, a);
                    if (std::min(glm::dot(n, a), glm::dot(n, b)) < 1e-3f) continue;
                    EXPECT_LT(glm::length(ab - ba), 1e-4f * (1 + glm::length(ab)));
                }
            }
}

TEST(Bsdf, LambertIsTheBaseColourOverPi) {
    Patch patch(Materials::lambert);
    patch.surface.metallic = 1;
    patch.surface.roughness = 0;
    patch.surface.transmission = 1;
    const auto bsdf = patch.bsdf();
    for (const float cosine : {0.1f, 0.5f, 1.0f}) {
        const auto expected = patch.surface.base_colour * (cosine / glm::pi<float>());
        EXPECT_LT(glm::distance(bsdf.evaluate(patch.direction(0.7f), patch.direction(cosine)), expected),
                  1e-6f);
        EXPECT_NEAR(bsdf.pdf(patch.direction(0.7f), patch.direction(cosine)), cosine / glm::pi<float>(),
                    1e-6f);
    }
    EXPECT_TRUE(bsdf.has_smooth_part());
    EXPECT_EQ(bsdf.albedo(), patch.surface.base_colour);
}

TEST(Bsdf, MetalnessBlendMixesLambertAndCookTorrance) {
    Patch patch(Materials::metalness_blend);
    patch.surface.roughness = 0.6f;
    const auto wo = patch.direction(0.8f, 0.1f), wi = patch.direction(0.6f, 2);
    const auto value = [&](float metallic) {
        patch.surface.metallic = metallic;
        return patch.bsdf().evaluate(wo, wi);
    };
    const auto lambert = patch.surface.base_colour * (0.6f / glm::pi<float>());
    EXPECT_LT(glm::distance(value(0), lambert), 1e-6f);
    EXPECT_LT(glm::distance(value(0.3f), 0.7f * lambert + 0.3f * value(1)), 1e-6f);

    // [Smal19 eqs. 3.5-3.8] in double precision, written down as printed
    const auto n = glm::dvec3(patch.surface.shading_normal_ws);
    const auto h = glm::normalize(glm::dvec3(wo) + glm::dvec3(wi));
    const double alpha = 0.36, nh = glm::dot(n, h), a2 = alpha * alpha;
    const double d = a2 / (glm::pi<double>() * std::pow(nh * nh * (a2 - 1) + 1, 2));
    const auto g = [&](double c) { return 2 / (1 + std::sqrt(1 + a2 * (1 - c * c) / (c * c))); };
    const glm::dvec3 f0(patch.surface.base_colour);
    const auto f = f0 + (1.0 - f0) * std::pow(1 - glm::dot(glm::dvec3(wo), h), 5);
    const auto expected = d * g(0.8) * g(0.6) * f / (4 * 0.8 * 0.6) * 0.6;
    EXPECT_LT(glm::distance(glm::dvec3(value(1)), expected), 1e-5);
}

TEST(Bsdf, DirectionalAlbedoIsTheKnownOne) {
    // α = 0.5, F = 1, cosθ = 0.2: 0.739 with Smith's separable masking and shadowing
    Patch patch(Materials::metalness_blend);
    patch.surface.base_colour = glm::vec3(1);
    patch.surface.roughness = std::sqrt(0.5f);
    patch.surface.metallic = 1;
    EXPECT_NEAR(directional_albedo(patch, patch.direction(0.2f)), 0.739, 1e-3);
}

/// Of a white surface, the largest over roughnesses and angles.
double largest_albedo(Materials model, float metallic) {
    double largest = 0;
    for (const float roughness : {0.3f, 0.6f, 1.0f})
        for (const float cosine : {0.05f, 0.3f, 1.0f}) {
            Patch patch(model);
            patch.surface.base_colour = glm::vec3(1);
            patch.surface.roughness = roughness;
            patch.surface.metallic = metallic;
            largest = std::max(largest, directional_albedo(patch, patch.direction(cosine)));
        }
    return largest;
}

TEST(Bsdf, ReflectsNoMoreThanArrives) {
    for (const float metallic : {0.0f, 0.5f, 1.0f}) {
        EXPECT_LT(largest_albedo(Materials::metalness_blend, metallic), 1.001);
        EXPECT_LT(largest_albedo(Materials::lambert, metallic), 1.001);
    }
    EXPECT_LT(largest_albedo(Materials::gltf, 1), 1.001);
    // its Lambert part is dimmed by the half vector's Fresnel term, which at grazing angles is not what the
    // interface reflects
    EXPECT_NEAR(largest_albedo(Materials::gltf, 0), 1.325, 0.005);
}

TEST(Bsdf, SidesOfBothNormalsCount) {
    Patch patch;
    patch.surface.metallic = 0.5f;
    const auto frame = patch.frame();
    patch.surface.geometric_normal_ws = glm::normalize(frame * glm::vec3(0.8f, 0, 0.6f));
    const auto bsdf = patch.bsdf();
    const auto wo = patch.direction(0.9f, 0);
    const auto hidden = frame * glm::normalize(glm::vec3(-0.9f, 0, 0.3f));  // above n, below the triangle
    const auto below = frame * glm::normalize(glm::vec3(0.9f, 0, -0.1f));   // and the other way round
    EXPECT_EQ(bsdf.evaluate(wo, hidden), glm::vec3(0));
    EXPECT_GT(bsdf.pdf(wo, hidden), 0) << "sample() tries there and gives up";
    EXPECT_EQ(bsdf.evaluate(wo, below), glm::vec3(0));
    EXPECT_EQ(bsdf.pdf(wo, below), 0);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    int none = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto s = bsdf.sample(wo, unit(random), {unit(random), unit(random)});
        none += !s;
        if (s) {
            EXPECT_GT(glm::dot(s->wi, patch.surface.geometric_normal_ws), 0);
            EXPECT_GT(glm::dot(s->wi, patch.surface.shading_normal_ws), 0);
        }
    }
    EXPECT_GT(none, 100);
    EXPECT_LT(none, 1500);
}

TEST(Bsdf, UnlitMaterialsReflectNothing) {
    for (const auto model : models) {
        Patch patch(model);
        patch.surface.is_unlit = true;
        const auto bsdf = patch.bsdf();
        EXPECT_FALSE(bsdf.has_smooth_part());
        EXPECT_EQ(bsdf.evaluate(patch.direction(0.5f), patch.direction(0.6f)), glm::vec3(0));
        EXPECT_FALSE(bsdf.sample(patch.direction(0.5f), 0.3f, {0.2f, 0.6f}));
        EXPECT_EQ(bsdf.albedo(), glm::vec3(0));
    }
}

TEST(Bsdf, SmoothMetalIsAMirror) {
    Patch patch;
    patch.surface.roughness = 0.03f;  // α = 9e-4
    patch.surface.metallic = 1;
    const auto bsdf = patch.bsdf();
    EXPECT_FALSE(bsdf.has_smooth_part());
    const auto s = bsdf.sample(patch.direction(0.4f, 1), 0.7f, {0.1f, 0.2f});
    ASSERT_TRUE(s);
    EXPECT_TRUE(s->is_specular);
    EXPECT_FALSE(s->is_transmitted);
    EXPECT_EQ(s->pdf, 0);
    EXPECT_LT(glm::distance(s->wi, patch.direction(0.4f, 1 + glm::pi<float>())), 1e-6f);
    const auto fresnel = passes::schlick_fresnel(patch.surface.base_colour, 0.4f);
    EXPECT_LT(glm::distance(s->weight, fresnel), 1e-5f);
    patch.surface.roughness = 0.04f;
    EXPECT_TRUE(patch.bsdf().has_smooth_part());
}

TEST(Bsdf, SmoothPlasticIsAMirrorOverLambert) {
    Patch patch;
    patch.surface.roughness = 0;
    patch.surface.metallic = 0;
    const auto bsdf = patch.bsdf();
    const auto wo = patch.direction(0.4f);
    EXPECT_TRUE(bsdf.has_smooth_part());
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    glm::dvec3 mirror(0);
    constexpr int n = 40000;
    for (int i = 0; i < n; ++i) {
        const auto s = bsdf.sample(wo, (i + unit(random)) / n, {unit(random), unit(random)});
        ASSERT_TRUE(s);
        if (s->is_specular) mirror += glm::dvec3(s->weight) / double{n};
    }
    EXPECT_LT(glm::length(mirror - glm::dvec3(passes::schlick_fresnel(glm::vec3(0.04f), 0.4f))), 1e-4);
}

TEST(Bsdf, StaysFiniteWhereTheViewerIsBelowTheShadingNormal) {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> unit(0, 1);
    for (const auto model : models)
        for (const float roughness : {0.0f, 0.05f, 0.5f})
            for (const float cosine : {-1.0f, -0.5f, -1e-3f, 0.0f, 5e-5f}) {
                Patch patch(model);
                patch.surface.roughness = roughness;
                patch.surface.metallic = 0.7f;
                patch.surface.transmission = 0.5f;
                const auto wo = patch.direction(cosine);
                patch.surface.geometric_normal_ws = wo;
                const auto bsdf = patch.bsdf();
                for (int i = 0; i < 200; ++i) {
                    const auto s = bsdf.sample(wo, unit(random), {unit(random), unit(random)});
                    if (!s) continue;
                    EXPECT_NEAR(glm::length(s->wi), 1, 1e-5f);
                    EXPECT_TRUE(std::isfinite(s->pdf) && s->pdf >= 0);
                    EXPECT_TRUE(std::isfinite(s->weight.x) && s->weight.x >= 0);
                    EXPECT_TRUE(std::isfinite(bsdf.evaluate(wo, random_hemisphere(patch, random)).x));
                }
            }
}

class BrdfTwin : public gl::ShaderLibTest {};
INSTANTIATE_ON_BOTH_BACKENDS(BrdfTwin);

TEST_P(BrdfTwin, GltfEqualsTheShadersFunction) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<glm::mat4> given;  // columns: n and r, l and g, v and b, (metallic, roughness, index)
    Patch patch;
    const auto n = patch.surface.shading_normal_ws;
    for (int i = 0; i < 4000; ++i) {
        const auto v = i % 5 ? random_hemisphere(patch, random) : patch.direction(-0.2f * unit(random), 1.7f);
        const glm::vec4 material(i % 3 ? unit(random) : 0, 0.15f + 0.85f * unit(random), 1 + unit(random), 0);
        given.emplace_back(glm::vec4(n, unit(random)),
                           glm::vec4(random_hemisphere(patch, random), unit(random)),
                           glm::vec4(v, unit(random)), material);
    }
    const auto expected =
        map<glm::vec4>(given, "brdf.glsl", "mat4", "vec4",
                       "mat4 p = given[i];\n"
                       "    Surface s = Surface(vec3(p[0].w, p[1].w, p[2].w), p[3].x, p[3].y, p[3].z);\n"
                       "    result[i] = vec4(gltf_brdf(s, p[0].xyz, p[1].xyz, p[2].xyz), 0);");
    double largest = 0;
    for (std::size_t i = 0; i < given.size(); ++i) {
        const auto& p = given[i];
        patch.surface.base_colour = {p[0].w, p[1].w, p[2].w};
        patch.surface.metallic = p[3].x;
        patch.surface.roughness = p[3].y;
        patch.material.ior = p[3].z;
        const glm::vec3 l(p[1]), v(p[2]);
        const auto value = patch.bsdf().evaluate(v, l) / glm::dot(n, l);
        EXPECT_LT(glm::distance(value, glm::vec3(expected[i])), 2e-3f * glm::length(value) + 1e-5f) << i;
        largest = std::max(largest, double{value.x});
    }
    EXPECT_GT(largest, 1) << "no highlight was compared";
}

/// Where a shading normal leans away from the viewer, light may come from straight behind the surface.
TEST_P(BrdfTwin, LightOppositeToTheViewHasNoHalfVector) {
    for (const auto model : {Materials::gltf, Materials::metalness_blend}) {
        Patch patch(model);
        patch.surface.roughness = 0.5f;
        patch.surface.metallic = 0.6f;
        patch.material.ior = 1.5f;
        const auto n = patch.surface.shading_normal_ws;
        std::vector<glm::mat4> given;  // columns: n, l, v
        for (const float cosine : {0.01f, 0.5f, 1.0f}) {
            const auto l = patch.direction(cosine, 1.7f);
            EXPECT_EQ(passes::half_vector(n, l, -l), n);
            given.emplace_back(glm::vec4(n, 0), glm::vec4(l, 0), glm::vec4(-l, 0), glm::vec4(0));
        }
        const std::string function = model == Materials::gltf ? "gltf_brdf" : "metalness_blend_brdf";
        const auto found = map<glm::vec4>(
            given, "brdf.glsl", "mat4", "vec4",
            "mat4 p = given[i];\n    Surface s = Surface(vec3(0.8, 0.5, 0.3), 0.6, 0.5, 1.5);\n"
            "    result[i] = vec4(" +
                function + "(s, p[0].xyz, p[1].xyz, p[2].xyz), 0);");
        for (std::size_t i = 0; i < given.size(); ++i) {
            const glm::vec3 l(given[i][1]);
            const auto value = patch.bsdf().evaluate(-l, l) / glm::dot(n, l);
            ASSERT_TRUE(std::isfinite(value.x + value.y + value.z));
            EXPECT_LT(glm::distance(value, glm::vec3(found[i])), 2e-3f * glm::length(value)) << i;
        }
    }
}

}  // namespace
}  // namespace ir::test
