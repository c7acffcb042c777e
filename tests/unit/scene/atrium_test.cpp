#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "renderers/core/error.h"
#include "renderers/scene/scene.h"
#include "tests/unit/scene/first_hit.h"

namespace ir::scene {
namespace {

std::size_t triangle_count(const Scene& scene) {
    std::size_t count = 0;
    for (const auto& mesh : scene.meshes) count += mesh.indices.size() / 3;
    return count;
}

const Scene& atrium() {
    static const Scene scene = make_builtin("atrium");
    return scene;
}

TEST(Atrium, HasAbout260000TrianglesAndScales) {
    EXPECT_NEAR(static_cast<double>(triangle_count(atrium())), 260000, 26000);
    const double coarse = static_cast<double>(triangle_count(make_builtin("atrium?detail=0.05")));
    const double half = static_cast<double>(triangle_count(make_builtin("atrium?detail=0.5")));
    const double twice = static_cast<double>(triangle_count(make_builtin("atrium?detail=2")));
    EXPECT_LT(coarse, 60000);
    EXPECT_GT(half, 1.5 * coarse);
    EXPECT_NEAR(half / static_cast<double>(triangle_count(atrium())), 0.55, 0.12);
    EXPECT_NEAR(twice / static_cast<double>(triangle_count(atrium())), 1.9, 0.15);
    EXPECT_THROW(make_builtin("atrium?detail=0.01"), UsageError);
    EXPECT_THROW(make_builtin("atrium?detail=5"), UsageError);
}

TEST(Atrium, HasTheStatedSize) {
    glm::vec3 low(1e9f), high(-1e9f);
    for (const auto& mesh : atrium().meshes)
        for (const auto& p : mesh.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    const glm::vec3 size = high - low;
    EXPECT_NEAR(size.x, 30, 0.5);
    EXPECT_NEAR(size.y, 12.5, 0.6);
    EXPECT_NEAR(size.z, 18, 0.5);
}

TEST(Atrium, MaterialsHaveTexturesNormalMapsAndHoles) {
    int textured = 0, with_normals = 0, masked = 0, emissive = 0;
    std::set<std::string> names;
    for (const auto& material : atrium().materials) {
        EXPECT_TRUE(names.insert(material.name).second) << material.name;
        textured += material.base_colour_texture.texture >= 0;
        with_normals += material.normal_texture.texture >= 0;
        masked += material.alpha_mode == AlphaMode::mask;
        emissive += material.emission.r > 0;
        for (const auto& slot : {material.base_colour_texture, material.normal_texture})
            ASSERT_LT(slot.texture, static_cast<int>(atrium().textures.size()));
        if (material.normal_texture.texture >= 0) {
            EXPECT_FALSE(atrium().textures[material.normal_texture.texture].srgb);
        }
    }
    EXPECT_GE(textured, 4);
    EXPECT_GE(with_normals, 2);
    EXPECT_GE(masked, 2);
    EXPECT_GE(emissive, 1);
}

TEST(Atrium, TexturesAreSound) {
    for (const auto& texture : atrium().textures) {
        ASSERT_EQ(texture.rgba.size(), static_cast<std::size_t>(texture.width) * texture.height * 4);
        if (texture.srgb) continue;
        double mean_z = 0;
        for (std::size_t i = 0; i < texture.rgba.size(); i += 4) {
            glm::vec3 n;
            for (int k = 0; k < 3; ++k) n[k] = texture.rgba[i + k] / 127.5f - 1;
            ASSERT_NEAR(glm::length(n), 1, 0.02) << texture.name;
            mean_z += n.z;
        }
        mean_z /= texture.width * texture.height;
        EXPECT_GT(mean_z, 0.7) << texture.name;
        EXPECT_LT(mean_z, 0.999) << texture.name << " is flat";
    }
    for (const auto& material : atrium().materials) {
        if (material.alpha_mode != AlphaMode::mask) continue;
        const Texture& texture = atrium().textures[material.base_colour_texture.texture];
        std::size_t covered = 0;
        for (std::size_t i = 3; i < texture.rgba.size(); i += 4) covered += texture.rgba[i] > 127;
        const double part = static_cast<double>(covered) / (texture.width * texture.height);
        EXPECT_TRUE(part > 0.2 && part < 0.8) << material.name << " covers " << part;
    }
}

TEST(Atrium, NormalMappedMeshesHaveTangents) {
    for (const auto& mesh : atrium().meshes) {
        if (atrium().materials[mesh.material].normal_texture.texture < 0) continue;
        ASSERT_EQ(mesh.tangents.size(), mesh.positions.size()) << mesh.name;
        for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
            ASSERT_NEAR(glm::length(glm::vec3(mesh.tangents[i])), 1, 1e-3) << mesh.name;
            ASSERT_NEAR(glm::dot(glm::vec3(mesh.tangents[i]), mesh.normals[i]), 0, 1e-3) << mesh.name;
        }
    }
}

TEST(Atrium, CamerasStandInTheOpen) {
    for (const char* name : {"nave", "gallery", "court", "aisle", "balcony", "overview"}) {
        const Camera* camera = nullptr;
        for (const auto& each : atrium().cameras)
            if (each.name == name) camera = &each;
        ASSERT_TRUE(camera) << name;
        const glm::vec3 forward = glm::normalize(camera->target - camera->eye);
        const glm::vec3 right = glm::normalize(glm::cross(forward, camera->up)),
                        up = glm::cross(right, forward);
        for (const float x : {-0.8f, 0.0f, 0.8f})
            for (const float y : {-0.5f, 0.0f, 0.5f})
                EXPECT_GT(
                    first_hit(atrium(), camera->eye, glm::normalize(forward + x * right + y * up), false),
                    0.3f)
                    << name << " " << x << " " << y;
    }
}

TEST(Atrium, HasFloorsUnderItsStoreysAndSkyOverTheCourt) {
    const glm::vec3 down(0, -1, 0), up(0, 1, 0);
    const auto below = [&](glm::vec3 p) { return p.y - first_hit(atrium(), p, down, false); };
    EXPECT_NEAR(below({3, 1.5f, 6.3f}), 0, 1e-3);
    EXPECT_NEAR(below({3, 7, 6.3f}), 5.6f, 1e-3);
    EXPECT_NEAR(below({-13, 7, 0.3f}), 5.6f, 1e-3);
    EXPECT_NEAR(below({5, 1.5f, 1.2f}), -0.34f, 1e-3);
    EXPECT_TRUE(std::isinf(first_hit(atrium(), {5, 1.5f, 1.2f}, up, false)));
    EXPECT_LT(first_hit(atrium(), {3, 7, 6.3f}, up, false), 5);     // the roof
    EXPECT_LT(first_hit(atrium(), {3, 1.5f, 6.3f}, up, false), 4);  // a vault
}

TEST(Atrium, ColumnsStandOnTheFloorAndCarryTheArches) {
    // Plinths reach into the floor and abaci into the arches' feet, both by less than five centimetres.
    int found = 0;
    for (const auto& mesh : atrium().meshes) {
        if (mesh.name != "lower columns" && mesh.name != "upper columns") continue;
        ++found;
        const float floor = mesh.name == "lower columns" ? 0 : 5.6f, arch = floor > 0 ? 8.4f : 3.3f;
        float low = 1e9f, high = -1e9f;
        for (const auto& p : mesh.positions) {
            low = std::min(low, p.y);
            high = std::max(high, p.y);
        }
        EXPECT_TRUE(low < floor && low > floor - 0.05f) << mesh.name;
        EXPECT_TRUE(high > arch && high < arch + 0.05f) << mesh.name;
    }
    EXPECT_EQ(found, 2);
}

TEST(Atrium, SunReachesTheCourt) {
    bool found = false;
    for (const auto& light : atrium().lights) {
        if (light.type != LightType::directional) continue;
        found = true;
        EXPECT_NEAR(glm::length(light.direction), 1, 1e-5);
        EXPECT_TRUE(std::isinf(first_hit(atrium(), {6, 0, -2.2f}, -light.direction, false)));
    }
    EXPECT_TRUE(found);
}

}  // namespace
}  // namespace ir::scene
