// A picture's file says how it was rendered: `rerun` renders it again, `diff` tells two of them apart.
#include "renderers/image/exr.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

class RerunCommand : public CommandTest {
  protected:
    Json rerun(const std::string& arguments) const {
        return Json::parse(output("rerun " + arguments + " --quiet --json"));
    }
    /// Everything that a command line can say of a picture.
    std::string elaborate(const std::string& out, const std::string& scene = "builtin:cornell") const {
        return "render --scene " + scene +
               " --method ssdo --size 24x16 --seed 7 --set paths=full --set max_distance=0.3 "
               "--eye 0.1,0.2,3 --target 0,0,0 --fov-y 35 --env 0.2,0.1,0.3 "
               "--light 'spot:position=0,0.5,0;target=0,0,0;intensity=2;inner=30;outer=40' "
               "--light 'point:position=0.3,0.3,0.3;intensity=1' --quiet --out " +
               file(out);
    }
};

TEST_F(RerunCommand, TheSamePictureComesOutBitForBit) {
    output(elaborate("a.exr") + " --dump 'gbuffer.normal'");
    const auto again = rerun(file("a.exr") + " --exact --out " + file("b.exr"));
    EXPECT_EQ(again["pixels"], 24 * 16);
    EXPECT_EQ(again["pixels_that_differ"], 0);
    EXPECT_EQ(again["different"], Json::array());
    ImageAttributes a, b;
    const auto before = read_exr(file("a.exr"), &a), after = read_exr(file("b.exr"), &b);
    ASSERT_EQ(before.size(), after.size()) << "the layers are those of the file";
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_EQ(before[i].name, after[i].name);
        EXPECT_EQ(before[i].image.pixels, after[i].image.pixels) << before[i].name;
    }
    EXPECT_EQ(a, b);
    // A copy tells as much as the original.
    EXPECT_EQ(rerun(file("b.exr"))["pixels_that_differ"], 0);
}

/// The current folder and the project may be gone.
TEST_F(RerunCommand, AProjectsExperimentNeedsNoProject) {
    const auto project = std::string(SOURCE_ROOT) + "/projects/samples/corridor-lamp.interreflect";
    output("render " + project + " --size 24x16 --frames 2 --quiet --out " + file("out"));
    int pictures = 0;
    for (const auto& entry : fs::directory_iterator(file("out"))) {
        if (entry.path().extension() != ".exr") continue;
        ++pictures;
        EXPECT_EQ(rerun(entry.path().string())["pixels_that_differ"], 0) << entry.path();
    }
    EXPECT_GT(pictures, 0);
}

TEST_F(RerunCommand, ChangesSayHowFarThePixelsAreApart) {
    output(elaborate("a.exr"));
    const auto other = rerun(file("a.exr") + " --set max_distance=1 --out " + file("b.exr"));
    EXPECT_GT(other["pixels_that_differ"], 0);
    EXPECT_GT(other["rmse"], 0);
    EXPECT_GE(other["largest_difference"], other["rmse"]);
    EXPECT_EQ(run("rerun " + file("a.exr") + " --set max_distance=1 --exact --quiet").status, 4);
    EXPECT_FALSE(rerun(file("a.exr") + " --size 12x8").contains("pixels")) << "nothing to compare";

    const auto told = Json::parse(output("diff " + file("a.exr") + " " + file("b.exr") + " --json"));
    ASSERT_EQ(told.size(), 1u) << told;
    EXPECT_EQ(told[0]["what"], "set.max_distance");
    EXPECT_EQ(told[0]["a"], "0.3");
    EXPECT_EQ(told[0]["b"], "1");
    EXPECT_EQ(output("diff " + file("a.exr") + " " + file("a.exr")), "nothing differs\n");
}

TEST_F(RerunCommand, DiffTellsLightsAndMaterialsOneByOne) {
    output(elaborate("a.exr"));
    auto other = elaborate("b.exr");
    other.replace(other.find("intensity=2"), 11, "intensity=3");
    output(other);
    const auto told = output("diff " + file("a.exr") + " " + file("b.exr"));
    EXPECT_NE(told.find("lights/0/lights/0/intensity: 2.0 | 3.0\n"), std::string::npos) << told;
    EXPECT_EQ(told.find("scenes"), std::string::npos) << told;
}

TEST_F(RerunCommand, FilesThatMovedAreNamed) {
    std::ofstream(file("triangle.gltf")) << R"({"asset": {"version": "2.0"}, "scene": 0,
        "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
    output(elaborate("a.exr", file("triangle.gltf")));
    EXPECT_EQ(rerun(file("a.exr"))["pixels_that_differ"], 0);
    fs::rename(file("triangle.gltf"), file("moved.gltf"));
    expect_refused("rerun " + file("a.exr"), 3, "triangle.gltf, which is not there; --scene");
    EXPECT_EQ(rerun(file("a.exr") + " --scene " + file("moved.gltf"))["pixels_that_differ"], 0);
    // Another scene's picture is told to be one.
    const auto other = rerun(file("a.exr") + " --scene builtin:cornell");
    ASSERT_FALSE(other["different"].empty());
    EXPECT_EQ(other["different"][0]["what"], "scene_hash");
}

TEST_F(RerunCommand, RefusesWhatDoesNotSayHowItWasRendered) {
    write_exr(file("plain.exr"), {{"", {"Y"}, Image(2, 2, 1)}}, {});
    expect_refused("rerun " + file("plain.exr"), 3, "does not say how it was rendered");
    expect_refused("diff " + file("plain.exr") + " " + file("plain.exr"), 3, "does not say");
    expect_refused("rerun " + file("missing.exr"), 3, "missing.exr");
    write_exr(file("odd.exr"), {{"", {"Y"}, Image(2, 2, 1)}}, {{"interreflect.recipe", "{\"schema\": 6"}});
    expect_refused("rerun " + file("odd.exr"), 3, "odd.exr");
    output(elaborate("a.exr"));
    expect_refused("rerun " + file("a.exr") + " --out " + file("a.exr"), 2, "is the file of FILE");
    expect_refused("rerun " + file("a.exr") + " --set max_distanse=1", 2, "did you mean 'max_distance'?");
    expect_refused("rerun " + file("a.exr") + " --sead 3", 2, "did you mean '--seed'?");
    expect_refused("rerunn " + file("a.exr"), 2, "did you mean 'rerun'?");
}

TEST_F(RerunCommand, StatisticsSayWhatWasRendered) {
    const auto all = Json::parse(output(elaborate("a.exr") + " --json"));
    const auto& picture = all["picture"];
    EXPECT_EQ(picture["method"], "ssdo");
    EXPECT_EQ(picture["scene"], "builtin:cornell");
    EXPECT_EQ(picture["size"], (Json{24, 16}));
    EXPECT_EQ(picture["seed"], 7);
    EXPECT_EQ(picture["values"]["paths"], "full");
    EXPECT_NEAR(picture["values"]["max_distance"].get<double>(), 0.3, 1e-6);
    EXPECT_NEAR(picture["camera"]["eye"][2].get<double>(), 3, 1e-6);
    EXPECT_NEAR(picture["camera"]["fov_y_degrees"].get<double>(), 35, 1e-4);
    EXPECT_NE(all["command"].get<std::string>().find("--seed 7"), std::string::npos);
    EXPECT_FALSE(all["build"].get<std::string>().empty());
}

TEST_F(RerunCommand, APngHoldsTheMainResultAlone) {
    output(elaborate("a.png"));
    const auto image = read_image(file("a.png"));
    EXPECT_EQ(image.width, 24);
    EXPECT_EQ(image.height, 16);
    expect_refused(elaborate("b.png") + " --dump 'gbuffer.*'", 2, "--dump");
}

}  // namespace
}  // namespace ir
