// A pane of tinted glass before a wall: every rasterised method draws the wall, as it would without the pane.
#include <algorithm>

#include "renderers/passes/scattering/microfacets.h"
#include "tests/image/methods/every_method.h"

namespace ir::test {
namespace {

constexpr int width = 32, height = 24;
const glm::vec3 tint(0.9f, 0.6f, 0.3f);

void add_quad(scene::Scene& scene, int material, glm::vec3 centre, glm::vec2 half, bool to_viewer = true) {
    scene::Mesh mesh;
    mesh.material = material;
    const float x = to_viewer ? half.x : -half.x, y = half.y;
    mesh.positions = {centre + glm::vec3(-x, -y, 0), centre + glm::vec3(x, -y, 0),
                      centre + glm::vec3(x, y, 0), centre + glm::vec3(-x, y, 0)};
    mesh.normals.assign(4, {0, 0, to_viewer ? 1 : -1});
    mesh.uv0.assign(4, {0, 0});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene::Node node;
    node.meshes = {static_cast<int>(scene.meshes.size())};
    scene.meshes.push_back(std::move(mesh));
    scene.nodes.push_back(node);
}

enum class Pane { none, thin, thick, thin_beside_one_that_shines };

/// A red wall of 3 m before nothing, lit from the side, so that the pane's shadow falls beside it; the pane
/// stands 2 m before it, over its right half and beyond. What is small and far away makes the bounds the
/// same.
scene::Scene wall_behind(Pane pane) {
    scene::Scene scene;
    scene.name = "wall";
    scene.materials.resize(2);
    scene.materials[0].base_colour = {0.8f, 0.3f, 0.2f, 1};
    scene.materials[0].metallic = 0;
    auto& glass = scene.materials[1];
    glass.metallic = glass.roughness = 0;
    glass.base_colour = glm::vec4(tint, 1);
    glass.transmission = 1;
    if (pane == Pane::thick) {
        glass.thickness = 0.1f;
        glass.attenuation_colour = {0.9f, 0.7f, 0.5f};
        glass.attenuation_distance = 0.1f;
    }
    add_quad(scene, 0, {0, 0, 0}, {1.5f, 1.5f});
    add_quad(scene, 0, {-4, -3, 3.5f}, {0.1f, 0.1f});
    add_quad(scene, 0, {4, 3, 3.5f}, {0.1f, 0.1f});
    if (pane != Pane::none) add_quad(scene, 1, {0.75f, 0, 2}, {0.6f, 0.6f});
    if (pane == Pane::thick) add_quad(scene, 1, {0.75f, 0, 1.9f}, {0.6f, 0.6f}, false);
    if (pane == Pane::thin_beside_one_that_shines) {
        scene.materials.push_back(scene.materials[1]);
        scene.materials[2].emission = glm::vec3(1);
        add_quad(scene, 2, {-0.75f, 0, 2}, {0.1f, 0.1f});
    }
    scene::Light light;
    light.type = scene::LightType::directional;
    light.direction = glm::normalize(glm::vec3(-2, 0, -1));
    light.intensity = 10;
    scene.lights = {light};
    scene::Camera camera;
    camera.eye = {0, 0, 6};
    scene.cameras = {camera};
    return scene;
}

class GlassBefore : public testing::Test {
  protected:
    struct Picture {
        Image main, valid, lit;
        std::optional<Image> glass;
        std::vector<Message> messages;
    };
    static void TearDownTestSuite() { machines().clear(); }

    Picture render(const graph::Method& method, const Settings& settings, Pane pane) const {
        auto& machine = test::machine();
        const auto scene = wall_behind(pane);
        const auto world = scene::flatten(scene, 0, 0);
        graph::Graph graph(machine.device(), &machine.context(), &machine.programs());
        graph::FrameInputs inputs;
        inputs.scene = &scene;
        inputs.world = &world;
        inputs.view = inputs.previous_view = scene::make_view(scene.cameras[0], width, height, world.bounds);
        graph::FrameOptions options;
        options.wanted = {"gbuffer.*", "lit"};
        const auto report = graph.run(method, settings, inputs, options);
        const auto* main =
            main_output(method.description, completed(method.description.parameters, settings));
        Picture picture{
            graph.read_image(main->key).value(), {}, {}, graph.read_image("gbuffer.glass"), report.messages};
        if (auto valid = graph.read_image("valid")) picture.valid = *valid;
        if (auto lit = graph.read_image("lit")) picture.lit = *lit;
        return picture;
    }
    /// All that the pane could take from the wall is left out: direct light, and surfaces within half a
    /// metre.
    static Settings settings_of(const MethodDescription& method) {
        auto settings = quick_settings(method);
        if (const auto* paths = find(method.parameters, "paths"))
            for (const char* key : {"ao", "direct"})
                if (paths->supported.empty() || std::find(paths->supported.begin(), paths->supported.end(),
                                                          key) != paths->supported.end())
                    settings["paths"] = std::string(key);
        if (settings.count("max_distance")) settings["max_distance"] = 0.5;
        return settings;
    }
    static std::ptrdiff_t notes(const Picture& picture, const std::string& text) {
        return std::ranges::count_if(picture.messages, [&](const Message& message) {
            return message.text.find(text) != std::string::npos;
        });
    }
    static const graph::Method& method(const std::string& id) {
        for (const auto* m : methods::all_methods())
            if (m->description.id == id) return *m;
        throw std::out_of_range(id);
    }
};

/// `behind` times what the glass lets through, where there is any; the same bits elsewhere.
void expect_seen_through(const Image& found, const Image& behind, const Image& glass, bool is_tinted) {
    int through = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < std::min(found.channels, 3); ++c) {
                const bool is_glass = glass.at(x, y, 3) > 0;
                const float factor = is_glass && is_tinted ? glass.at(x, y, c) : 1;
                through += is_glass;
                if (is_glass)
                    ASSERT_NEAR(found.at(x, y, c), behind.at(x, y, c) * factor, 1e-5f) << x << ' ' << y;
                else
                    ASSERT_EQ(found.at(x, y, c), behind.at(x, y, c)) << x << ' ' << y;
            }
    EXPECT_GT(through, 50);
}

TEST_F(GlassBefore, EveryRasterisedMethodDrawsWhatLiesBehind) {
    for (const auto* m : methods::all_methods()) {
        if (m->description.is_reference) continue;
        SCOPED_TRACE(m->description.id);
        const auto settings = settings_of(m->description);
        const auto behind = render(*m, settings, Pane::none), seen = render(*m, settings, Pane::thin);
        ASSERT_TRUE(seen.glass);
        EXPECT_FALSE(behind.glass);
        const auto* main = main_output(m->description, completed(m->description.parameters, settings));
        expect_seen_through(seen.main, behind.main, *seen.glass, main->semantic == Semantic::radiance);
        if (!seen.lit.pixels.empty()) expect_seen_through(seen.lit, behind.lit, *seen.glass, true);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width && !seen.valid.pixels.empty(); ++x)
                EXPECT_EQ(seen.valid.at(x, y), seen.glass->at(x, y, 3) > 0 ? 0 : behind.valid.at(x, y));
    }
}

TEST_F(GlassBefore, LightThroughItIsThatOfTheReferenceWithoutReflections) {
    Settings full{{"paths", std::string("full")}, {"samples", std::int64_t(512)}};
    for (const auto pane : {Pane::thin, Pane::thick}) {
        const auto truth = render(method("reference"), full, pane);
        const auto drawn = render(method("ssdo"), {{"paths", std::string("direct")}}, pane);
        ASSERT_TRUE(drawn.glass);
        glm::dvec3 sum_of_truth(0), sum_drawn(0);
        int pixels = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                // of the pixels that show the wall's inner part, whole panes
                if (drawn.glass->at(x, y, 3) < (pane == Pane::thick ? 2 : 1) || drawn.main.at(x, y) == 0)
                    continue;
                ++pixels;
                for (int c = 0; c < 3; ++c) {
                    sum_of_truth[c] += truth.main.at(x, y, c);
                    sum_drawn[c] += drawn.main.at(x, y, c);
                }
            }
        EXPECT_GT(pixels, 30);
        // About 20000 paths, of which one in twelve is reflected: a standard error of 0.2 %. Reflections
        // within the slab bring another 0.2 %.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum_drawn[c] / sum_of_truth[c], 1, 0.02) << "channel " << c;
    }
}

TEST_F(GlassBefore, IsNotWhiteAndSaysWhatIsLeftOut) {
    const auto seen = render(method("ssdo"), {{"paths", std::string("direct")}}, Pane::thin);
    const int x = width / 2 + 2, y = height / 2;
    ASSERT_GT(seen.glass->at(x, y, 3), 0);
    EXPECT_GT(seen.main.at(x, y, 0), 3 * seen.main.at(x, y, 1)) << "the red wall";
    const auto* drawn = "glass is drawn as what lies behind it";
    EXPECT_EQ(notes(seen, drawn), 1);
    EXPECT_EQ(notes(render(method("ssdo"), {{"paths", std::string("direct")}}, Pane::none), drawn), 0);
}

TEST_F(GlassBefore, MethodsSayWhereItStopsTheirIndirectLight) {
    const auto count = [&](const char* id, const char* paths, Pane pane, const Settings& more = {}) {
        const auto settings =
            with(with(quick_settings(method(id).description), more), {{"paths", std::string(paths)}});
        return notes(render(method(id), settings, pane), "glass is opaque to");
    };
    const Settings opaque{{"glass", std::string("opaque")}};
    EXPECT_EQ(count("deep-screen-space", "indirect", Pane::thin, opaque), 1);
    EXPECT_EQ(count("deep-screen-space", "indirect", Pane::none, opaque), 0);
    EXPECT_EQ(count("deep-screen-space", "indirect", Pane::thin), 0) << "rays go through it";
    EXPECT_EQ(count("deep-screen-space", "indirect", Pane::thin_beside_one_that_shines), 1);
    EXPECT_EQ(count("deep-screen-space", "indirect", Pane::thin, {{"visibility", false}}), 1);
    EXPECT_EQ(count("ldm-indirect", "indirect", Pane::thin), 1);
    EXPECT_EQ(count("ldm-indirect", "direct", Pane::thin), 0);
    EXPECT_EQ(count("photon-mapping", "indirect", Pane::thin), 0) << "photons go through it";
}

TEST_F(GlassBefore, IsASurfaceWithLambertMaterials) {
    const Settings lambert{{"paths", std::string("direct")}, {"materials", std::string("lambert")}};
    const auto seen = render(method("ssdo"), lambert, Pane::thin);
    const auto truth = render(method("reference"), lambert, Pane::thin);
    EXPECT_FALSE(seen.glass);
    const int x = width / 2 + 2, y = height / 2;
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(seen.main.at(x, y, c), truth.main.at(x, y, c), 1e-3);  // half floats
    EXPECT_GT(seen.main.at(x, y, 1), 0.5f * seen.main.at(x, y, 0)) << "the pane's own colour";
}

}  // namespace
}  // namespace ir::test
