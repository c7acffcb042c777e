#include "renderers/passes/scene/texel_buffer.h"

#include <cstring>

#include "renderers/core/record.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/scene/hit_surfaces.h"
#include "renderers/passes/surface/surface.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {
namespace {

scene::Texture random_texture(int width, int height, std::mt19937& random) {
    scene::Texture texture;
    texture.width = width, texture.height = height;
    texture.rgba.resize(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (auto& byte : texture.rgba) byte = static_cast<std::uint8_t>(random());
    texture.srgb = random() % 2 == 0;
    texture.sampler.wrap_s = static_cast<scene::Wrap>(random() % 3);
    texture.sampler.wrap_t = static_cast<scene::Wrap>(random() % 3);
    texture.sampler.mag = random() % 3 == 0 ? scene::Filter::nearest : scene::Filter::linear;
    return texture;
}

/// Triangles of twelve materials whose textures have all wraps, filters, encodings, transforms and uv sets.
scene::Scene textured_scene() {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(-1, 1);
    scene::Scene scene;
    scene.cameras.emplace_back();
    for (int i = 0; i < 12; ++i) {
        scene::Material m;
        m.base_colour = {0.9f, 0.8f, 0.7f, 1};
        m.metallic = 0.8f, m.roughness = 0.9f, m.transmission = 0.5f, m.normal_scale = 0.7f, m.ior = 1.3f;
        m.unlit = i == 5;
        for (auto* slot : {&m.base_colour_texture, &m.metallic_roughness_texture, &m.normal_texture,
                           &m.transmission_texture}) {
            if (i == 0) continue;
            slot->texture = static_cast<int>(scene.textures.size());
            scene.textures.push_back(random_texture(1 + static_cast<int>(random() % 9), 7, random));
            slot->uv_set = static_cast<int>(random() % 2);
            slot->offset = {unit(random), unit(random)};
            slot->scale = {2 * unit(random), unit(random)};
            slot->rotation = 3 * unit(random);
        }
        scene.materials.push_back(m);
        scene::Mesh mesh;
        mesh.material = i;
        for (unsigned j = 0; j < 30; ++j) {
            mesh.positions.emplace_back(unit(random), unit(random), unit(random));
            mesh.normals.push_back(random_direction(random));
            mesh.tangents.emplace_back(random_direction(random), j % 2 ? 1 : -1);
            mesh.uv0.emplace_back(3 * unit(random), 3 * unit(random));
            mesh.uv1.emplace_back(3 * unit(random), 3 * unit(random));
            if (i % 2 == 0) mesh.colours.emplace_back(0.5f + 0.5f * unit(random), 0.6f, 0.7f, 1);
            mesh.indices.push_back(j);
        }
        if (mesh.colours.empty()) mesh.colours.clear();
        scene::Node node;
        node.meshes = {i};
        scene.meshes.push_back(std::move(mesh));
        scene.nodes.push_back(node);
    }
    return scene;
}

struct Question {
    std::uint32_t triangle;
    float u, v;
    glm::vec3 direction;
    IR_FIELDS(triangle, u, v, direction)
};
struct Answer {
    glm::vec3 position, geometric, shading, base_colour;
    float metallic, roughness, transmission, ior;
    std::uint32_t material, is_front, is_unlit;
    IR_FIELDS(position, geometric, shading, base_colour, metallic, roughness, transmission, ior, material,
              is_front, is_unlit)
};

/// Constants of hit_surface.comp.
struct AnswerQuestions {
    unsigned questions_requested;
    bool normal_maps;
    IR_FIELDS(questions_requested, normal_maps)
};

class HitSurfaceTest : public PassTest {
  protected:
    std::vector<Answer> query(const Shot& shot, const std::vector<Question>& questions, bool normal_maps) {
        run(shot, [&](graph::GraphBuilder& builder) {
            const auto surfaces = passes::hit_surfaces(builder, passes::upload_scene(builder));
            const auto given = builder.buffer({.text = {.key = "test.questions", .label = "Questions"},
                                               .fields = record_fields<Question>(),
                                               .elements = questions.size()});
            const auto found = builder.buffer({.text = {.key = "test.answers", .label = "Answers"},
                                               .fields = record_fields<Answer>(),
                                               .elements = questions.size()});
            builder.pass("upload questions").writes(given).execute([=](graph::PassContext& context) {
                context.upload(given, std::as_bytes(std::span(questions)));
            });
            auto pass = builder.pass("answer");
            surfaces.read_by(pass);
            const auto count = questions.size();
            pass.reads("Questions", given)
                .writes("Answers", found)
                .compute({{SOURCE_ROOT "/tests/data/shaders/hit_surface.comp"}},
                         static_cast<std::int64_t>(count),
                         AnswerQuestions{static_cast<unsigned>(count), normal_maps});
        });
        const auto bytes = graph().read_buffer("test.answers").value();
        std::vector<Answer> answers(questions.size());
        std::memcpy(answers.data(), bytes.data(), answers.size() * sizeof(Answer));
        return answers;
    }
};

TEST_F(HitSurfaceTest, EqualsTheHosts) {
    const auto scene = textured_scene();
    const Shot shot(scene, scene.cameras[0], 8, 8);
    std::mt19937 random(6);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<Question> questions;
    for (int i = 0; i < 5000; ++i) {
        float u = unit(random), v = unit(random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        questions.push_back(
            {static_cast<std::uint32_t>(random() % shot.world.triangles()), u, v, random_direction(random)});
    }
    for (const bool normal_maps : {false, true}) {
        const passes::SurfaceLookup lookup(shot.scene, shot.world, normal_maps);
        const auto answers = query(shot, questions, normal_maps);
        int at_texel_edges = 0;
        for (std::size_t i = 0; i < questions.size(); ++i) {
            const auto& q = questions[i];
            const auto& a = answers[i];
            const auto s = lookup.at({1, q.triangle, q.u, q.v}, q.direction);
            ASSERT_LT(glm::distance(a.position, s.position_ws), 1e-5f);
            ASSERT_LT(glm::distance(a.geometric, s.geometric_normal_ws), 1e-4f);
            ASSERT_EQ(a.material, static_cast<unsigned>(s.material));
            ASSERT_EQ(a.is_front != 0, s.is_front);
            ASSERT_EQ(a.is_unlit != 0, s.is_unlit);
            ASSERT_FLOAT_EQ(a.ior, 1.3f);
            at_texel_edges += glm::distance(a.shading, s.shading_normal_ws) > 2e-3f ||
                              glm::distance(a.base_colour, s.base_colour) > 1e-3f ||
                              std::abs(a.metallic - s.metallic) > 1e-3f ||
                              std::abs(a.roughness - s.roughness) > 1e-3f ||
                              std::abs(a.transmission - s.transmission) > 1e-3f;
        }
        // where the nearest texel is queried, rounding may choose its neighbour
        EXPECT_LE(at_texel_edges, 5) << "of 5000";
    }
}

TEST(TexelLayout, LeavesOutWhatNoSurfaceAsks) {
    scene::Scene scene;
    std::mt19937 random(1);
    for (int i = 0; i < 3; ++i) scene.textures.push_back(random_texture(8, 4, random));
    scene.materials.resize(1);
    scene.materials[0].base_colour_texture.texture = 1;
    scene.materials[0].emission_texture.texture = 2;
    const auto layout = passes::texel_layout(scene);
    EXPECT_EQ(layout.textures[0].width, 0);
    EXPECT_EQ(layout.textures[2].width, 8);
    EXPECT_EQ(layout.textures[1].width, 8);
    EXPECT_EQ(layout.words, 256u + 3 * 4 + 2 * 32);
    EXPECT_EQ(layout.reduced, 0);
    std::uint32_t texel;
    std::memcpy(&texel, &scene.textures[1].rgba[4 * 9], 4);
    EXPECT_EQ(passes::texel_words(scene, layout)[layout.textures[1].first_word + 9], texel);
}

TEST(TexelLayout, ReducesByTheMeanOfDecodedTexels) {
    scene::Scene scene;
    scene::Texture texture;
    texture.width = 5, texture.height = 2;
    texture.srgb = true;
    texture.rgba.assign(40, 0);
    for (const std::size_t white : {0, 6})  // of the first block of four and of the second
        for (std::size_t i = 0; i < 4; ++i) texture.rgba[4 * white + i] = 255;
    scene.textures.push_back(texture);
    scene.materials.resize(1);
    scene.materials[0].base_colour_texture.texture = 0;
    const auto layout = passes::texel_layout(scene, passes::max_texel_bytes, 4);
    ASSERT_EQ(layout.textures[0].width, 3);
    ASSERT_EQ(layout.textures[0].height, 1);
    EXPECT_EQ(layout.reduced, 1);
    const auto words = passes::texel_words(scene, layout);
    // two of four texels are white in the first block (0 and 6 in a row of 5: below 1): sRGB of 1/2 is 188
    EXPECT_EQ(words[layout.textures[0].first_word] & 255u, 188u);
    EXPECT_EQ(words[layout.textures[0].first_word + 2] & 255u, 0u);
}

TEST(TexelLayout, HalvesUntilAllFits) {
    scene::Scene scene;
    std::mt19937 random(1);
    for (int i = 0; i < 4; ++i) scene.textures.push_back(random_texture(64, 64, random));
    scene.materials.resize(4);
    for (int i = 0; i < 4; ++i) scene.materials[static_cast<std::size_t>(i)].base_colour_texture.texture = i;
    const auto layout = passes::texel_layout(scene, 20'000);
    EXPECT_EQ(layout.side, 32);
    EXPECT_LE(4 * layout.words, 20'000u);
    EXPECT_EQ(layout.reduced, 4);
}

}  // namespace
}  // namespace ir::test
