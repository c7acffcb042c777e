// The contract with scripts: exit statuses, one-line errors, files and JSON, on the real program.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "projects/document_fields.h"
#include "projects/store.h"
#include "renderers/core/resources_path.h"
#include "renderers/image/exr.h"
#include "tests/small_sample.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

class Cli : public CommandTest {
  protected:
    std::string small(const std::string& method, const std::string& out) const {
        return "render --scene builtin:cornell --method " + method + " --size 24x16 --quiet --out " +
               file(out) + " ";
    }
};

TEST_F(Cli, SaysWhatItIs) {
    EXPECT_EQ(run("--version").status, 0);
    const auto info = nlohmann::json::parse(run("info --json").out);
    EXPECT_TRUE(info.contains("backend"));
    EXPECT_TRUE(info.contains("device"));
    const auto list = nlohmann::json::parse(run("list --json").out);
    ASSERT_FALSE(list.empty());
    for (const auto& method : list) {
        const auto id = method["id"].get<std::string>();
        const auto described = nlohmann::json::parse(run("describe " + id + " --json").out);
        EXPECT_EQ(described["id"], id);
        EXPECT_NE(run("describe " + id + " --markdown").out.find(id), std::string::npos);
        EXPECT_EQ(run("describe " + id + " --glsl").status, 0);
    }
    const auto scene = nlohmann::json::parse(run("scene builtin:cornell --json").out);
    EXPECT_EQ(scene["triangles"], 36);
}

/// Libraries of images, windows and drivers take 0.2 s and more to load.
TEST_F(Cli, StartsWithoutWhatOnlySomeCommandsNeed) {
    const auto loaded = file("loaded");
    const auto command = "LD_DEBUG=files " + std::string(CLI_PROGRAM) + " list >/dev/null 2>" + loaded;
    ASSERT_EQ(std::system(command.c_str()), 0);
    const auto libraries = read(loaded);
    EXPECT_NE(libraries.find("libtinygltf"), std::string::npos);
    for (const auto* library : {"libOpenImageIO", "libQt6", "libLLVM", "libOSMesa"})
        EXPECT_EQ(libraries.find(library), std::string::npos) << library;
}

TEST_F(Cli, RefusesWrongUsageInOneLine) {
    expect_refused("scene builtin:nowhere", 2, "nowhere");
    expect_refused("describe no-such-method", 2, "no-such-method");
    expect_refused(small("reference", "a.exr") + "--set no_such_key=1", 2, "no_such_key");
    expect_refused(small("reference", "a.exr") + "--set samples=many", 2, "samples");
    expect_refused(small("reference", "a.exr") + "--set samples=0", 2, "samples");
    expect_refused(small("reference", "a.exr") + "--camera nowhere", 2, "nowhere");
    expect_refused(small("reference", "a.exr") + "--light lamp:x=1", 2, "lamp");
    expect_refused(small("reference", "a.jpg"), 2, ".exr or .png");
    expect_refused(small("reference", "a.exr") + "--dump 'no.such.*'", 2, "no.such.*");
    expect_refused("render --scene builtin:cornell --out " + file("a.exr"), 2, "--method");
    expect_refused("no-such-command", 2, "no-such-command");
    expect_refused("", 2, "give a command");
    expect_refused("info one two", 2, "not expected: one, two;");
    expect_refused(small("reference", "a.exr") + "--env 1,-1,1", 2, "--env");
    expect_refused(small("reference", "a.exr") + "--seed -1", 2, "--seed");
    expect_refused(small("reference", "a.exr") + "--time nan", 2, "--time");
    expect_refused(small("reference", "a.exr") + "--fov-y 20", 2, "--fov-y");
    expect_refused(small("reference", "a.exr") + "--keep", 2, "--keep");
    expect_refused(small("reference", "no-folder/a.exr"), 2, "no-folder");
    expect_refused(small("reference", "a.exr") + "--device no-such-device", 1, "no-such-device");
}

TEST_F(Cli, LostOutputIsNoSuccess) {
    const auto command = std::string(CLI_PROGRAM) + " list >/dev/full 2>" + file("lost");
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
    EXPECT_NE(read(file("lost")).find("standard output"), std::string::npos);
}

TEST_F(Cli, RefusesBadFilesWithStatusThree) {
    expect_refused("scene " + file("missing.glb"), 3, "missing.glb");
    std::ofstream(file("broken.gltf")) << "{\"asset\": {\"version\": \"2.0\"}, \"extensionsRequired\": "
                                          "[\"KHR_texture_basisu\"], \"extensionsUsed\": "
                                          "[\"KHR_texture_basisu\"]}";
    expect_refused("scene " + file("broken.gltf"), 3, "KHR_texture_basisu");
    expect_refused("compare " + file("missing.exr") + " " + file("missing.exr"), 3, "missing.exr");
    expect_refused("project " + file("missing.interreflect"), 3, "missing.interreflect");
}

TEST_F(Cli, RunsTheBodiesOfTheProcessorThatIsAskedFor) {
    std::map<std::string, std::vector<ImageLayer>> pictures;
    for (const std::string processor : {"gl", "host"}) {
        const auto name = processor + ".exr";
        const auto outcome = run(small("ldm-ao", name) +
                                 "--set directions=8 --set resolution=32 --json - --processor " + processor);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const auto statistics = nlohmann::json::parse(outcome.out);
        EXPECT_EQ(statistics["processor"], processor);
        bool streamed = false;
        for (const auto& pass : statistics["passes"]) streamed |= pass["name"] == "build and trace maps";
        EXPECT_EQ(streamed, processor == "host");
        ImageAttributes attributes;
        pictures[processor] = read_exr(file(name), &attributes);
        EXPECT_EQ(attributes.at("interreflect.processor"), processor);
    }
    const auto &gl = pictures["gl"].front().image, &host = pictures["host"].front().image;
    ASSERT_EQ(gl.pixels.size(), host.pixels.size());
    double sum = 0;
    for (std::size_t i = 0; i < gl.pixels.size(); ++i) sum += std::abs(gl.pixels[i] - host.pixels[i]);
    EXPECT_LT(sum / static_cast<double>(gl.pixels.size()), 3e-3);  // 384 pixels, of which edges differ
    const auto software = nlohmann::json::parse(run("info --json").out)["software"].get<bool>();
    const auto chosen = run(small("ldm-ao", "auto.exr") + "--set directions=8 --set resolution=32 --json -");
    EXPECT_EQ(nlohmann::json::parse(chosen.out)["processor"], software ? "host" : "gl");
    expect_refused(small("ldm-ao", "a.exr") + "--processor gpu", 2, "auto, gl and host");
}

TEST_F(Cli, ShadersMayComeFromAnotherFolder) {
    expect_refused(small("view-normals", "a.exr") + "--shaders " + file("nowhere"), 2, "has no folder lib/");
    const auto folder = file("shaders");
    std::filesystem::copy(shader_directory(), folder, std::filesystem::copy_options::recursive);
    const auto shader = folder + "/methods/view-normals/view_normals.frag";
    std::ofstream(shader, std::ios::app) << "\nwrong\n";
    expect_refused(small("view-normals", "a.exr") + "--shaders " + folder, 1,
                   "methods/view-normals/view_normals.frag:");
    std::ofstream(shader) << "layout(location = 0) out vec4 normal;\nuniform sampler2D normal_image;\n"
                             "uniform mat4 view_from_world;\n"
                             "void main() { normal = vec4(params.as_colour) + 0.5; }\n";
    ASSERT_EQ(run(small("view-normals", "a.exr") + "--shaders " + folder).status, 0);
    EXPECT_EQ(read_exr(file("a.exr")).front().image.pixels.front(), 0.5f);
    const auto note_of = [&](const char* processor) {
        return run(small("hbao", "b.exr") + "--processor " + processor + " --shaders " + folder).err;
    };
    EXPECT_NE(note_of("host").find("use no shaders of --shaders"), std::string::npos);
    EXPECT_EQ(note_of("gl").find("use no shaders of --shaders"), std::string::npos);
}

TEST_F(Cli, PrintsWhatShadersSayOfThePickedPixel) {
    const auto folder = file("shaders");
    std::filesystem::copy(shader_directory(), folder, std::filesystem::copy_options::recursive);
    std::ofstream(folder + "/methods/view-normals/view_normals.frag")
        << "#include \"lib/debug.glsl\"\nlayout(location = 0) out vec4 normal;\n"
           "uniform sampler2D normal_image;\nuniform mat4 view_from_world;\n"
           "void main() {\n    normal = vec4(params.as_colour);\n    print(gl_FragCoord.xy);\n}\n";
    const auto command = small("view-normals", "a.exr") + "--shaders " + folder + " --pick 5,3";
    const std::string place = "methods/view-normals/view_normals.frag:7";
    EXPECT_EQ(output(command), place + ": gl_FragCoord.xy = 5.5 3.5\n");
    const auto statistics = nlohmann::json::parse(output(command + " --json -"));
    EXPECT_EQ(statistics["printed"][0]["place"], place);
    EXPECT_EQ(statistics["printed"][0]["text"], "5.5 3.5");
    EXPECT_EQ(output(small("view-normals", "a.exr") + "--shaders " + folder), "") << "no pixel is picked";
}

TEST_F(Cli, RendersLayersAndStatistics) {
    const auto outcome =
        run(small("ldm-ao", "a.exr") +
            "--set directions=8 --set resolution=32 --dump 'gbuffer.*' --dump ldm.directions --json -");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto statistics = nlohmann::json::parse(outcome.out);
    for (const auto* key :
         {"backend", "device", "processor", "wall_ms", "passes", "counters", "memory_bytes"})
        EXPECT_TRUE(statistics.contains(key)) << key;
    for (const auto& pass : statistics["passes"])
        for (const auto* key : {"name", "gpu_ms", "cpu_ms"}) EXPECT_TRUE(pass.contains(key)) << key;
    ImageAttributes attributes;
    const auto layers = read_exr(file("a.exr"), &attributes);
    ASSERT_FALSE(layers.empty());
    EXPECT_EQ(layers.front().name, "");
    EXPECT_EQ(layers.front().channels, std::vector<std::string>{"Y"});
    EXPECT_EQ(layers.front().image.width, 24);
    const auto has = [&](const std::string& name) {
        return std::any_of(layers.begin(), layers.end(),
                           [&](const auto& layer) { return layer.name == name; });
    };
    EXPECT_TRUE(has("valid"));
    EXPECT_TRUE(has("gbuffer.position"));
    EXPECT_TRUE(has("ldm.directions"));
    EXPECT_EQ(attributes.at("interreflect.set.directions"), "8");
    EXPECT_EQ(attributes.at("interreflect.method"), "ldm-ao");
}

TEST_F(Cli, ComparesAndFailsAboveALimit) {
    ASSERT_EQ(run(small("reference", "a.exr") + "--set samples=8 --seed 1").status, 0);
    ASSERT_EQ(run(small("reference", "b.exr") + "--set samples=8 --seed 2").status, 0);
    const auto pair = "compare " + file("a.exr") + " " + file("b.exr") + " ";
    const auto json =
        nlohmann::json::parse(run(pair + "--json --metric rmse,mae,psnr --diff " + file("d.exr")).out);
    EXPECT_GT(json["metrics"]["rmse"], 0);
    EXPECT_TRUE(fs::exists(file("d.exr")));
    EXPECT_EQ(run(pair + "--fail-above rmse=1").status, 0);
    EXPECT_EQ(run(pair + "--fail-above rmse=0").status, 4);
    const auto same = "compare " + file("a.exr") + " " + file("a.exr") + " ";
    EXPECT_EQ(run(same + "--fail-above rmse=0").status, 0);
    ASSERT_EQ(
        run("render --scene builtin:cornell --method reference --size 8x8 --quiet --out " + file("c.exr"))
            .status,
        0);
    expect_refused("compare " + file("a.exr") + " " + file("c.exr"), 3, "24");
}

TEST_F(Cli, DescribesOneParameterOutputOrSelector) {
    const auto parameter = run("describe ldm-ao exact_texels");
    EXPECT_EQ(parameter.out.rfind("# `exact_texels`\n", 0), 0u) << parameter.out;
    EXPECT_NE(parameter.out.find("Only where `exact` is near."), std::string::npos) << parameter.out;
    EXPECT_EQ(parameter.out.find("max_distance"), std::string::npos) << parameter.out;
    const auto json = nlohmann::json::parse(run("describe ldm-ao exact --json").out);
    EXPECT_EQ(json["key"], "exact");
    const auto older = nlohmann::json::parse(run("describe deep-screen-space blur_normal_power --json").out);
    EXPECT_EQ(older["value_in_older_projects"], 16) << "whose default the pass does not know";
    EXPECT_NE(run("describe ldm-ao valid").out.find("semantic: "), std::string::npos);
    expect_refused("describe ldm-ao exact_texel", 2, "did you mean 'exact_texels'");
    expect_refused("describe ldm-ao exact --glsl", 2, "--glsl");
}

TEST_F(Cli, SaysWhichSettingsDoNothing) {
    const auto idle = run(small("ldm-ao", "idle.exr") + "--set exact_texels=8");
    ASSERT_EQ(idle.status, 0) << idle.err;
    EXPECT_NE(idle.err.find("--set exact_texels=8 does nothing here"), std::string::npos) << idle.err;
    const auto used = run(small("ldm-ao", "used.exr") + "--set exact=near --set exact_texels=8");
    ASSERT_EQ(used.status, 0) << used.err;
    EXPECT_EQ(used.err.find("does nothing"), std::string::npos) << used.err;
    // A chain: no gloss, so nothing looks through maps, so what is near does not matter.
    const auto chain = run(small("ldm-indirect", "chain.exr") +
                           "--set directions=8 --set resolution=32 --set emission=4 --set gloss=none "
                           "--set gloss_tracer=maps --set gloss_near=2");
    ASSERT_EQ(chain.status, 0) << chain.err;
    EXPECT_NE(chain.err.find("--set gloss_near=2 does nothing here"), std::string::npos) << chain.err;
}

TEST_F(Cli, GrowsBuffersThatStartAThousandTimesTooSmall) {
    const auto settings = std::string(
        "--processor gl --set directions=16 --set resolution=48 --set progressive=true --frames 3 --json ");
    ASSERT_EQ(
        run(small("ldm-ao", "large.exr") + settings + file("large.json") + " --initial-capacity 8").status,
        0);
    ASSERT_EQ(run(small("ldm-ao", "small.exr") + settings + file("small.json") + " --initial-capacity 0.001")
                  .status,
              0);
    EXPECT_EQ(nlohmann::json::parse(read(file("large.json")))["counters"]["growth"], 0);
    EXPECT_GE(nlohmann::json::parse(read(file("small.json")))["counters"]["growth"], 1);
    EXPECT_EQ(run("compare " + file("large.exr") + " " + file("small.exr") + " --fail-above rmse=0").status,
              0);
}

TEST_F(Cli, WorksInBatchesWithinABudgetOrSaysWhatToLower) {
    const auto settings = std::string("--processor gl --set directions=64 --set resolution=128 --json ");
    ASSERT_EQ(run(small("ldm-ao", "free.exr") + settings + file("free.json") + " --memory 0").status, 0);
    const auto tight = run(small("ldm-ao", "tight.exr") + settings + file("tight.json") + " --memory 12MB");
    ASSERT_EQ(tight.status, 0) << tight.err;
    EXPECT_GT(nlohmann::json::parse(read(file("tight.json")))["counters"]["batches"], 1);
    EXPECT_EQ(run("compare " + file("free.exr") + " " + file("tight.exr") + " --fail-above rmse=1e-6").status,
              0);
    expect_refused(small("ldm-ao", "no.exr") + settings + file("no.json") + " --memory 20kB", 1, "--memory");
}

TEST_F(Cli, ChecksEverySampleAndRendersOne) {
    const auto folder = fs::path(SOURCE_ROOT) / "projects" / "samples";
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == projects::folder_suffix) {
            EXPECT_EQ(run("project " + entry.path().string() + " --check").status, 0) << entry.path();
        }
    const auto sample = test::small_sample("corner-closed-form", file("")).string();
    const auto outcome = run("render " + sample + " --experiment ldm --quiet --out " + file("out"));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(file("out/ldm.exr")));
    EXPECT_TRUE(fs::exists(file("out/ldm.json")));
    const auto as_json = run("render " + sample + " --experiment ldm --quiet --json --out " + file("out"));
    EXPECT_TRUE(nlohmann::json::parse(as_json.out)["ldm"].contains("passes"));
    expect_refused("render " + sample + " --out " + file("one.exr"), 2, "give a folder");
    expect_refused("render " + sample + " --env 1,1,1 --out " + file("out"), 2, "--env");
    expect_refused("render " + sample + " --size 8x8 --keep --out " + file("out"), 2, "--keep");
    expect_refused("render " + sample + " --set no_such_key=1 --out " + file("out"), 2, "no_such_key");
    ASSERT_EQ(run("render " + sample + " --experiment ldm --size 8x6 --set directions=8 --quiet --out " +
                  file("small"))
                  .status,
              0);
    EXPECT_EQ(read_image(file("small/ldm.exr")).width, 8);
}

TEST_F(Cli, OneUnknownMethodKeepsNoOtherExperimentFromRendering) {
    const auto sample = test::small_sample("corner-closed-form", file(""));
    auto json = nlohmann::ordered_json::parse(read(sample / "project.json"));
    json["experiments"][0]["method"] = "from-the-future";
    std::ofstream(sample / "project.json") << json.dump(2);
    const auto outcome = run("render " + sample.string() + " --quiet --out " + file("out"));
    EXPECT_EQ(outcome.status, 3);
    EXPECT_NE(outcome.err.find("from-the-future"), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(file("out/ldm.exr")));
    EXPECT_TRUE(fs::exists(file("out/reference.exr")));
}

TEST_F(Cli, KeepsAndVerifiesResults) {
    const auto project = test::small_sample("crevice-leaks", file("")).string();
    ASSERT_EQ(run("render " + project + " --experiment thick --keep --quiet --out " + file("out")).status, 0);
    const auto verified = nlohmann::json::parse(run("project " + project + " --verify --json --quiet").out);
    ASSERT_TRUE(verified.is_object());
    const auto& rows = verified["results"];
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0]["experiment"], "thick");
    EXPECT_EQ(rows[0]["identical"], true);
    EXPECT_TRUE(rows[0]["changed"].empty());
}

TEST_F(Cli, WritesNoTwoFilesToOnePlace) {
    expect_refused(small("view-normals", "a.exr") + "--json " + file("a.exr"), 2, "is the file of --out");
    EXPECT_FALSE(fs::exists(file("a.exr")));
}

TEST_F(Cli, HasTheLimitsOfTheDocument) {
    using namespace projects;
    const auto number = [](double value) { return ir::to_string(Value{value}); };
    const auto whole = [](double value) { return std::to_string(std::int64_t(value)); };
    const auto frames = field_of(experiment_fields(), "frames").text.range;
    const auto time = field_of(experiment_fields(), "time").text.range;
    const auto size = field_of(experiment_fields(), "size").text.range;
    const auto fov = field_of(camera_fields(), "fov_y_degrees").text.range;
    const std::string command =
        "render --scene builtin:cornell --method view-normals --eye 0,0,1 --target 0,0,0 ";
    const auto allowed = [&](const std::string& options) {  // refused for the file's name alone
        expect_refused(command + options + " --out a.jpg", 2, "--out");
    };
    allowed("--frames " + whole(frames.max) + " --time " + number(time.max) + " --fov-y " + number(fov.max) +
            " --size " + whole(size.max) + "x" + whole(size.max));
    allowed("--frames " + whole(frames.min) + " --time=" + number(time.min) + " --fov-y " + number(fov.min) +
            " --size 1x1");
    for (const auto& [option, value] : {std::pair("--frames", whole(frames.max + 1)),
                                        {"--frames", whole(frames.min - 1)},
                                        {"--time", number(2 * time.max)},
                                        {"--fov-y", number(fov.max + 0.001)},
                                        {"--size", whole(size.max + 1) + "x1"}})
        expect_refused(command + option + " " + value + " --out a.exr", 2, option);
}

TEST_F(Cli, SaysHowASceneIsGivenWhereAProjectIsExpected) {
    const auto scene = file("room.GLB"), out = file("out");
    for (const auto& given : {scene, std::string("builtin:atrium")}) {
        for (const std::string start : {"render ", "reference ", "plot ", "plot merge ", "sweep ", "project ",
                                        "report ", "figure --out f.pdf "})
            expect_refused(start + given, 2, given + " is a scene and no project; give it by --scene");
        expect_refused("render " + given + " --method ldm-ao --out " + out, 2, "render --scene " + given);
        expect_refused("thumbnail " + given + " " + out, 2, given + " is a scene");
    }
    fs::create_directories(folder_ / "room.glb");
    expect_refused("project " + file("room.glb"), 3, "holds no project.json");
}

TEST_F(Cli, RefusesWhatIsNoNumber) {
    for (const std::string option : {"--fov-y", "--initial-capacity", "--time"})
        expect_refused(small("view-normals", "a.exr") + option + " nan", 2, option);
    expect_refused(small("view-normals", "a.exr") + "--eye nan,0,1 --target 0,0,0", 2, "--eye");
    expect_refused(small("view-normals", "a.exr") + "--eye 1e39,0,1 --target 0,0,0", 2, "--eye");
}

}  // namespace
}  // namespace ir
