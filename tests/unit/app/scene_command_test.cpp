// What `scene` lists, of files that are in order and of files that are not.
#include <glm/gtc/constants.hpp>
#include <set>

#include "renderers/image/exr.h"
#include "tests/unit/app/outcome.h"
#include "tests/unit/scene/gltf_builder.h"

namespace ir {
namespace {

class SceneCommand : public CommandTest {
  protected:
    Json list(const std::string& scene) const { return Json::parse(output("scene " + scene + " --json")); }

    /// A lamp of 2 by 1 metres that emits 3 W/(m² sr), a point light, and extensions.
    std::string lamp() const {
        test::GltfBuilder builder;
        const std::vector<float> corners{0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0};
        const std::vector<std::uint16_t> indices{0, 1, 2, 0, 2, 3};
        const int positions = builder.accessor(builder.view(corners), test::type_float, "VEC3", 4);
        const int triangles = builder.accessor(builder.view(indices), test::type_ushort, "SCALAR", 6);
        builder.json["extensionsUsed"] = {"KHR_materials_emissive_strength", "KHR_lights_punctual",
                                          "KHR_materials_sheen", "ACME_magic"};
        builder.json["materials"] = {
            {{"name", "neon"},
             {"emissiveFactor", {1, 1, 1}},
             {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 3}}}}}}};
        builder.json["meshes"] = {
            {{"primitives",
              {{{"attributes", {{"POSITION", positions}}}, {"indices", triangles}, {"material", 0}}}}}};
        builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
            {{"type", "point"}, {"name", "bulb"}, {"intensity", 5}}};
        builder.json["nodes"] = {{{"mesh", 0}}, {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
        builder.json["scenes"] = {{{"nodes", {0, 1}}}};
        std::ofstream(file("lamp.gltf")) << builder.embedded_text();
        return file("lamp.gltf");
    }
};

TEST_F(SceneCommand, ListsWhatABuiltInSceneHolds) {
    const auto json = list("builtin:cornell");
    EXPECT_EQ(json["triangles"], 36);
    std::set<std::string> names;
    std::size_t triangles = 0;
    for (const auto& material : json["materials"]) {
        names.insert(material["name"]);
        triangles += material["triangles"].get<std::size_t>();
    }
    EXPECT_TRUE(names.count("red") && names.count("green") && names.count("white")) << json["materials"];
    EXPECT_EQ(triangles, json["instanced_triangles"]);
    EXPECT_EQ(json["extensions"], Json::array());
    EXPECT_GT(json["memory_bytes"]["triangles"], 36 * 3 * 12);
    ASSERT_FALSE(json["cameras"].empty());
    EXPECT_EQ(json["cameras"][0]["eye"].size(), 3u);
    EXPECT_FALSE(json["cameras"][0]["made_up"]);
}

TEST_F(SceneCommand, CountsTheMemoryOfTextures) {
    const auto json = list("builtin:still-life");
    std::size_t bytes = 0;
    for (const auto& texture : json["textures"])
        bytes += 4 * texture["size"][0].get<std::size_t>() * texture["size"][1].get<std::size_t>();
    EXPECT_GT(bytes, 0u);
    EXPECT_EQ(json["memory_bytes"]["textures"], bytes);
    for (const auto& material : json["materials"])
        for (const auto& place : material["textures"]) EXPECT_LT(place, json["textures"].size());
}

TEST_F(SceneCommand, SaysThePowerOfEmitters) {
    const auto emitters = list(lamp())["emitters"];
    ASSERT_EQ(emitters.size(), 2u);
    EXPECT_EQ(emitters[0]["source"], "point light 'bulb'");
    EXPECT_NEAR(emitters[0]["power_watts"].get<double>(), 5 * 4 * glm::pi<double>(), 1e-4);
    EXPECT_EQ(emitters[1]["source"], "emissive material 'neon'");
    EXPECT_EQ(emitters[1]["kind"], "surface");
    // Lambert's emitter sends π L A, from both sides.
    EXPECT_NEAR(emitters[1]["power_watts"].get<double>(), 2 * glm::pi<double>() * 3 * 2, 1e-4);
}

TEST_F(SceneCommand, SaysWhatIsDoneAboutExtensions) {
    const auto scene = lamp();
    const auto extensions = list(scene)["extensions"];
    ASSERT_EQ(extensions.size(), 4u);
    EXPECT_TRUE(extensions[0]["read"]);
    EXPECT_TRUE(extensions[1]["read"]);
    EXPECT_FALSE(extensions[2]["read"]);
    const auto text = output("scene " + scene);
    EXPECT_NE(text.find("KHR_lights_punctual: read: point, spot"), std::string::npos) << text;
    EXPECT_NE(text.find("KHR_materials_sheen: ignored: cloth has no sheen"), std::string::npos) << text;
    EXPECT_NE(text.find("ACME_magic: ignored: unknown"), std::string::npos) << text;
    EXPECT_NE(text.find("neon: triangles 2"), std::string::npos) << text;
}

TEST_F(SceneCommand, ListsVariantsAndRendersThem) {
    test::GltfBuilder builder;
    builder.json["materials"] = {{{"name", "dark"}, {"emissiveFactor", {0, 0, 0}}},
                                 {{"name", "bright"}, {"emissiveFactor", {1, 1, 1}}}};
    builder.draw({{"POSITION", builder.triangle_positions()}});
    auto& primitive = builder.json["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    builder.json["extensionsUsed"] = {"KHR_materials_variants"};
    builder.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "night"}},
                                                                        {{"name", "day"}}};
    primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 1}, {"variants", {1}}}};
    const auto scene = file("lamp.gltf");
    std::ofstream(scene) << builder.embedded_text();
    EXPECT_EQ(list(scene)["variants"], Json({"night", "day"}));
    const auto command = "render --scene " + scene +
                         " --method reference --set paths=full --set samples=1 --size 8x8 --out " +
                         file("a.exr");
    const auto brightness = [&](const std::string& option) {
        EXPECT_EQ(run(command + option).status, 0);
        float sum = 0;
        for (const float value : read_image(file("a.exr")).pixels) sum += value;
        return sum;
    };
    const float night = brightness(" --variant night");
    EXPECT_GT(brightness(" --variant day"), night + 10);
    EXPECT_EQ(brightness(""), night);
    const auto outcome = run(command + " --variant dai");
    EXPECT_NE(outcome.status, 0);
    EXPECT_NE(outcome.err.find("has no variant 'dai' (did you mean 'day'?); known are night, day"),
              std::string::npos)
        << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    const auto none =
        run("render --scene builtin:cornell --method view-normals --size 8x8 --variant day --out " +
            file("b.exr"));
    EXPECT_NE(none.err.find("has no variants of its materials"), std::string::npos) << none.err;
}

/// Every file is listed or refused in one line.
TEST_F(SceneCommand, ListsOrRefusesSharedScenes) {
    const char* folder = std::getenv("INTERREFLECT_SCENES");
    if (!folder) GTEST_SKIP() << "set INTERREFLECT_SCENES to the folder with corrupt/ and cornell/";
    std::set<fs::path> files;
    for (const char* part : {"corrupt", "cornell"})
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(folder) / part))
            if ((entry.path().extension() == ".gltf" || entry.path().extension() == ".glb") &&
                entry.file_size() < 100'000)
                files.insert(entry.path());
    constexpr std::size_t max_files = 40;
    const std::size_t step = std::max<std::size_t>(1, files.size() / max_files);
    std::size_t i = 0, listed = 0, refused = 0;
    for (const auto& each : files) {
        if (i++ % step != 0) continue;
        const auto outcome = run("scene '" + each.string() + "' --json");
        if (outcome.status == 0) {
            EXPECT_TRUE(Json::accept(outcome.out)) << each;
            ++listed;
        } else {
            EXPECT_EQ(outcome.status, 3) << each << outcome.err;
            EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
            ++refused;
        }
    }
    EXPECT_GT(listed, 5u);
    EXPECT_GT(refused, 5u);
}

TEST_F(SceneCommand, FilesOutsideAreReadWhereThatIsAllowed) {
    test::GltfBuilder builder;
    builder.draw({{"POSITION", builder.triangle_positions()}});
    builder.json["buffers"] = {{{"byteLength", builder.bytes.size()}, {"uri", "../a.bin"}}};
    fs::create_directories(file("scene"));
    std::ofstream(file("scene/a.gltf")) << builder.json.dump();
    std::ofstream(file("a.bin"), std::ios::binary)
        .write(reinterpret_cast<const char*>(builder.bytes.data()),
               static_cast<std::streamsize>(builder.bytes.size()));
    expect_refused("scene " + file("scene/a.gltf"), 3, "or allow it by --allow-outside");
    EXPECT_EQ(run("scene --allow-outside " + file("scene/a.gltf")).status, 0);
    const auto render = "render --scene " + file("scene/a.gltf") +
                        " --method view-normals --size 8x8 --out " + file("out.exr");
    expect_refused(render, 3, "or allow it by --allow-outside");
    EXPECT_EQ(run(render + " --allow-outside").status, 0);
}

}  // namespace
}  // namespace ir
