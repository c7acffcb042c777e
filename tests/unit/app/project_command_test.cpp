// `interreflect-cli project`: exit statuses, one line for errors, one JSON object, on the real program.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "projects/autosave.h"
#include "projects/lock.h"
#include "projects/results.h"
#include "renderers/core/resources_path.h"
#include "renderers/image/exr.h"
#include "tests/own_folder.h"
#include "tests/unit/app/outcome.h"
#include "tests/unit/scene/gltf_builder.h"

namespace ir {
namespace {

void write(const fs::path& path, const std::string& text) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
}

/// A copy of a sample project whose pictures are small.
class ProjectCommand : public testing::Test {
  protected:
    ProjectCommand() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        root_ = own_folder("project-" + std::string(test->name()));
        fs::remove_all(root_);
        project = root_ / "p.interreflect";
        json = Json::parse(
            read(fs::path(SOURCE_ROOT) / "projects/samples/crevice-leaks.interreflect/project.json"));
        json["experiments"].erase(json["experiments"].begin() + 1, json["experiments"].end());
        json["comparisons"] = json["sweeps"] = Json::array();
        for (const char* key : {"reference", "presets", "active_preset"}) json["experiments"][0].erase(key);
        json["experiments"][0]["size"] = {16, 12};
        store();
    }
    ~ProjectCommand() override { fs::remove_all(root_); }

    void store() { write(project / "project.json", json.dump(2)); }
    std::string id() { return json["experiments"][0]["id"]; }

    Outcome run(const std::string& arguments) { return run_program(arguments, root_); }
    Outcome command(const std::string& flags) { return run("project " + project.string() + " " + flags); }

    /// Refused with one line on stderr that names `part`, and nothing else.
    void expect_refused(const std::string& flags, int status, const std::string& part) {
        const auto outcome = command(flags);
        EXPECT_EQ(outcome.status, status) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }
    /// The messages of --check, which ends with `status`.
    std::string check(int status) {
        const auto outcome = command("--check --json");
        EXPECT_EQ(outcome.status, status) << outcome.out << outcome.err;
        const auto checked = Json::parse(outcome.out);
        EXPECT_TRUE(checked.is_object());
        return checked["messages"].dump();
    }
    void keep() {
        ASSERT_EQ(
            run("render " + project.string() + " --keep --quiet --out " + (root_ / "out").string()).status,
            0);
        json = Json::parse(read(project / "project.json"));
    }

    fs::path root_, project;
    Json json;
};

TEST_F(ProjectCommand, ChecksWhatIsThereAndWhatIsNot) {
    EXPECT_EQ(check(0), "[]");
    json["from_the_future"] = 1;
    store();
    EXPECT_NE(check(0).find("unknown key /from_the_future"), std::string::npos);
    const auto camera = json["experiments"][0]["camera"];
    json["experiments"][0]["camera"] = "gone";
    store();
    EXPECT_NE(check(3).find("project.json: /experiments/0/camera: experiment '" + id() +
                            "': there is no camera 'gone'; choose "),
              std::string::npos);
    json["experiments"][0]["camera"] = camera;
    json["scenes"][0]["parts"][0]["source"] = "gone.glb";
    store();
    EXPECT_NE(check(3).find("'gone.glb' is missing"), std::string::npos);
    EXPECT_EQ(command("").status, 0);  // looking is no checking

    write(project / "gone.glb", "there now");
    json["scenes"][0]["parts"][0]["content_hash"] = "of another file";
    store();
    EXPECT_NE(check(0).find("is not the file that was recorded"), std::string::npos);
}

/// Nodes have had slopes since version 2: an experiment of version 1 keeps the picture that it had.
TEST_F(ProjectCommand, AnOlderAmbientOcclusionKeepsItsPlainNodes) {
    json = {{"schema", projects::schema_version},
            {"scenes", {{{"id", "box"}, {"parts", {{{"source", "builtin:cornell@1"}}}}}}}};
    json["experiments"] = {
        {{"id", "a"}, {"scene", "box"}, {"method", "ldm-ao"}, {"method_version", 1}, {"size", {16, 12}}}};
    store();
    EXPECT_NE(check(0).find("nodes was not in the file; plain as before version 2"), std::string::npos);
}

/// What is left out has its default: nothing is said of that.
TEST_F(ProjectCommand, AProjectWrittenByHandIsNotTalkedAbout) {
    for (const char* method : {"view-normals", "ldm-ao", "reference"}) {
        SCOPED_TRACE(method);
        json = {{"schema", projects::schema_version},
                {"scenes", {{{"id", "box"}, {"parts", {{{"source", "builtin:cornell@1"}}}}}}}};
        json["experiments"] = {{{"id", "a"}, {"scene", "box"}, {"method", method}, {"size", {16, 12}}}};
        store();
        EXPECT_EQ(check(0), "[]");
        for (const char* flags : {"", "--check"}) {
            const auto outcome = command(flags);
            EXPECT_EQ(outcome.status, 0);
            EXPECT_EQ(outcome.err, "");
            EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 2) << outcome.out;
        }
    }
    json["experiments"][0]["method"] = "view-normals";
    store();
    const auto render = "render " + project.string() + " --quiet --out " + (root_ / "out").string();
    EXPECT_EQ(run(render).err, "");
    json["experiments"][0]["camara"] = "nave";
    json["experiments"][0]["values"]["directons"] = 4;
    store();
    const auto outcome = run(render);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 2) << outcome.err;
    for (const char* key : {"/experiments/0/camara", "/experiments/0/values/directons"})
        EXPECT_NE(outcome.err.find(std::string("note: unknown key ") + key), std::string::npos)
            << outcome.err;
}

/// A device may never end; it is no file that is missing.
TEST_F(ProjectCommand, DevicesAreNamedAsWhatTheyAre) {
    const auto out = (root_ / "out.exr").string();
    for (const std::string& line :
         {"render --scene /dev/zero --method view-normals --out " + out, std::string("scene /dev/zero"),
          std::string("compare /dev/zero /dev/zero"), std::string("project /dev/zero"),
          "project /dev/zero --unpack " + root_.string(), "render /dev/zero --out " + root_.string()}) {
        const auto outcome = run(line);
        EXPECT_EQ(outcome.status, 3) << line;
        EXPECT_NE(outcome.err.find("/dev/zero"), std::string::npos) << outcome.err;
        EXPECT_EQ(outcome.err.find("no such file"), std::string::npos) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
    EXPECT_NE(run("scene /dev/zero").err.find("regular file"), std::string::npos);
    EXPECT_NE(run("compare /dev/zero /dev/zero").err.find("is no regular file"), std::string::npos);
    EXPECT_NE(run("compare /nowhere.exr /dev/zero").err.find("there is no such file"), std::string::npos);
    json["scenes"][0]["parts"][0]["source"] = "/dev/zero";
    store();
    EXPECT_NE(check(3).find("'/dev/zero' is no regular file; locate another"), std::string::npos);
}

TEST_F(ProjectCommand, FilesOutsideAreToldAndUnpackedWhereThatIsAllowed) {
    const auto outside = (root_ / "outside.gltf").string();
    write(outside, "of somebody");
    json["scenes"][0]["parts"][0]["source"] = outside;
    store();
    EXPECT_NE(check(0).find("reads files outside of its folder: " + outside), std::string::npos);
    const auto packed = (root_ / "packed.tar").string();
    const auto there = (root_ / "there").string();
    fs::create_directories(there);
    ASSERT_EQ(std::system(("tar cf " + packed + " -C " + root_.string() + " p.interreflect").c_str()), 0);
    for (const auto& command :
         {"project " + packed + " --unpack " + there, "report " + packed + " --out " + there + "/a.html",
          "figure " + packed + " --out " + there + "/a.pdf"}) {
        const auto outcome = run(command);
        EXPECT_EQ(outcome.status, 3) << command;
        EXPECT_NE(outcome.err.find(outside + ": is named by the project and lies outside"), std::string::npos)
            << outcome.err;
        EXPECT_TRUE(fs::is_empty(there)) << command;
    }
    EXPECT_EQ(run("project " + packed + " --allow-outside --unpack " + there).status, 0);
}

constexpr const char* changed_normals = "methods/view-normals/view_normals.frag";

TEST_F(ProjectCommand, AnExperimentRendersWithItsChangedShaders) {
    auto& experiment = json["experiments"][0];
    for (const char* key : {"transport", "values"}) experiment.erase(key);
    experiment["method"] = "view-normals";
    experiment.erase("method_version");
    store();
    const auto render = [&](const std::string& options) {
        return run("render " + project.string() + " --quiet --out " + (root_ / "out").string() + " " +
                   options);
    };
    const auto picture = [&] {
        ImageAttributes attributes;
        const auto layers = read_exr(root_ / "out" / (id() + ".exr"), &attributes);
        return std::pair(layers.front().image.pixels, attributes);
    };
    ASSERT_EQ(render("").status, 0);
    const auto [plain, none] = picture();
    const auto plain_file = (root_ / "plain.exr").string(), page = (root_ / "page.html").string();
    fs::copy_file(root_ / "out" / (id() + ".exr"), plain_file);
    const std::string hunk = "@@ -14,1 +14,1 @@";
    const std::string old = "    normal.xyz = normalize(mat3(view_from_world) * normal_ws);";
    write(root_ / "a.diff", "--- a/shaders/" + std::string(changed_normals) + "\n+++ b/shaders/" +
                                changed_normals + "\n" + hunk + "\n-" + old +
                                "\n+    normal.xyz = vec3(0.25);\n");
    ASSERT_EQ(render("--shader-diff " + (root_ / "a.diff").string()).status, 0);
    const auto by_option = picture();
    EXPECT_NE(by_option.first, plain);
    experiment["shaders"][changed_normals] = {hunk, "-" + old, "+    normal.xyz = vec3(0.25);"};
    store();
    ASSERT_EQ(render("--keep").status, 0);
    const auto by_project = picture();
    EXPECT_EQ(by_project.first, by_option.first);
    const auto told = by_project.second.at("interreflect.shader." + std::string(changed_normals));
    EXPECT_EQ(told.find("+1 −1, "), 0u) << told;
    const auto statistics = Json::parse(read(root_ / "out" / (id() + ".json")));
    EXPECT_EQ(statistics["picture"]["shaders"][changed_normals], told);
    EXPECT_NE(command("").out.find("shader changed: " + std::string(changed_normals) + " (+1 −1)"),
              std::string::npos);
    ASSERT_EQ(
        run("report " + plain_file + " " + (root_ / "out" / (id() + ".exr")).string() + " --out " + page)
            .status,
        0);
    const auto html = read(page);
    const auto differing = html.find("Settings that differ"), all = html.find("All settings");
    EXPECT_LT(differing, html.find("Shader changed: " + std::string(changed_normals), differing));
    EXPECT_LT(html.find("Shader changed: " + std::string(changed_normals), differing), all);
    const auto again = "rerun " + (root_ / "out" / (id() + ".exr")).string() + " --quiet ";
    EXPECT_EQ(run(again).status, 3) << "a picture may come from anybody";
    EXPECT_NE(run(again).err.find("--allow-shaders"), std::string::npos) << run(again).err;
    EXPECT_NE(run(again).err.find("may come from anybody"), std::string::npos) << run(again).err;
    EXPECT_EQ(run(again).err.find("window"), std::string::npos) << "there is none here: " << run(again).err;
    EXPECT_EQ(run(again + "--allow-shaders --out " + (root_ / "again.exr").string()).status, 0);
    EXPECT_EQ(read_exr(root_ / "again.exr").front().image.pixels, by_project.first);

    experiment["shaders"][changed_normals] = {hunk, "-gone", "+new"};
    store();
    const auto refused = render("");
    EXPECT_EQ(refused.status, 1) << refused.err;
    EXPECT_NE(refused.err.find("experiment '" + id() + "': " + changed_normals +
                               ": its change does not fit the shader (any more): hunk 1"),
              std::string::npos)
        << refused.err;
    EXPECT_NE(check(3).find("its change does not fit"), std::string::npos);
}

TEST_F(ProjectCommand, ChangedShadersOfOthersRunWhereThatIsAllowed) {
    auto& experiment = json["experiments"][0];
    for (const char* key : {"transport", "values"}) experiment.erase(key);
    experiment["method"] = "view-normals";
    experiment.erase("method_version");
    experiment["shaders"][changed_normals] = {"@@ -1,1 +1,0 @@", "-odd"};
    store();
    const auto packed = (root_ / "packed.tar").string(), there = (root_ / "there").string();
    fs::create_directories(there);
    ASSERT_EQ(command("--pack " + packed).status, 0);
    ASSERT_EQ(run("project " + packed + " --unpack " + there).status, 0);
    const auto render = "render " + there + "/p.interreflect --quiet --out " + there + "/out";
    const auto refused = run(render);
    EXPECT_EQ(refused.status, 1) << refused.err;
    EXPECT_NE(refused.err.find("it changes shaders (" + std::string(changed_normals) + "), and comes from"),
              std::string::npos)
        << refused.err;
    EXPECT_NE(run(render + " --allow-shaders").err.find("does not fit"), std::string::npos);
    write(root_ / "a.diff", "--- a\n+++ b/" + std::string(changed_normals) +
                                "\n@@ -14,1 +14,1 @@\n-    normal.xyz = normalize(mat3(view_from_world) * "
                                "normal_ws);\n+    normal.xyz = vec3(0.25);\n");
    const auto own = run(render + " --shader-diff " + (root_ / "a.diff").string());
    EXPECT_EQ(own.status, 0) << "one's own change waits for nobody: " << own.err;
    EXPECT_NE(own.err.find("takes the place of what experiment '" + id() + "' changes in " +
                           std::string(changed_normals)),
              std::string::npos)
        << own.err;
    write(root_ / "same.diff", "--- a\n+++ b/" + std::string(changed_normals) + "\n@@ -1,1 +1,0 @@\n-odd\n");
    const auto same = run(render + " --shader-diff " + (root_ / "same.diff").string());
    EXPECT_NE(same.err.find("does not fit"), std::string::npos) << "also where it is the same: " << same.err;
    write(root_ / "b.diff", "--- a\n+++ b/lib/random.glsl\n@@ -0,0 +1,1 @@\n+// mine\n");
    const auto both = run(render + " --shader-diff " + (root_ / "b.diff").string());
    EXPECT_EQ(both.status, 1) << "what others change still does";
    EXPECT_NE(both.err.find("comes from somebody else"), std::string::npos) << both.err;
    fs::remove_all(there + "/p.interreflect");
    ASSERT_EQ(run("project " + packed + " --allow-shaders --unpack " + there).status, 0);
    EXPECT_NE(run(render).err.find("does not fit"), std::string::npos) << "allowed once";
}

TEST_F(ProjectCommand, APictureIsRenderedAgainWithOnesOwnChangeOfItsShaders) {
    const auto picture = (root_ / "a.exr").string(), again = (root_ / "b.exr").string();
    const auto render =
        "render --scene builtin:cornell --method view-normals --size 16x12 --quiet --out " + picture;
    ASSERT_EQ(run(render).status, 0);
    EXPECT_NE(run("rerun " + picture).out.find("bit for bit"), std::string::npos) << "a picture of vectors";
    write(root_ / "a.diff", "--- a\n+++ b/" + std::string(changed_normals) +
                                "\n@@ -14,1 +14,1 @@\n-    normal.xyz = normalize(mat3(view_from_world) * "
                                "normal_ws);\n+    normal.xyz = vec3(0.25);\n");
    const auto changed =
        run("rerun " + picture + " --shader-diff " + (root_ / "a.diff").string() + " --out " + again);
    EXPECT_EQ(changed.status, 0) << changed.err;
    EXPECT_NE(read_exr(again).front().image.pixels, read_exr(picture).front().image.pixels);

    const auto folder = root_ / "shaders";
    fs::copy(shader_directory(), folder, fs::copy_options::recursive);
    std::ofstream(folder / "lib/random.glsl", std::ios::app) << "// changed\n";
    ASSERT_EQ(run(render + " --shaders " + folder.string()).status, 0);
    const auto own = run("rerun " + picture);
    EXPECT_NE(own.out.find("different shader_folder: "), std::string::npos) << own.out;
}

TEST_F(ProjectCommand, ResultsKnowTheFolderOfTheirShaders) {
    const auto key = [&](const std::string& options) {
        EXPECT_EQ(
            run("render " + project.string() + " --keep --quiet --out " + (root_ / "out").string() + options)
                .status,
            0);
        const auto index = projects::ResultIndex::load(project);
        return index.last_kept()[id()];
    };
    const auto folder = root_ / "shaders";
    fs::copy(shader_directory(), folder, fs::copy_options::recursive);
    const auto own = key("");
    EXPECT_EQ(key(" --shaders " + folder.string()), own) << "a copy that changes nothing";
    std::ofstream(folder / "lib/random.glsl", std::ios::app) << "// changed\n";
    const auto edited = key(" --shaders " + folder.string());
    EXPECT_NE(edited, own);
    ImageAttributes attributes;
    read_exr(root_ / "out" / (id() + ".exr"), &attributes);
    EXPECT_TRUE(attributes.count("interreflect.shader_folder"));
    EXPECT_EQ(key(" --shaders " + folder.string()), edited);
    EXPECT_EQ(key(""), own);
}

TEST_F(ProjectCommand, ChecksResultsAndUnsavedChanges) {
    write(project / "results/index.json", "damaged");
    EXPECT_NE(check(3).find("index.json: line 1"), std::string::npos);
    write(project / "results/index.json",
          R"({"schema": 1, "entries": [{"key": "k", "files": [{"path": "a"}]}]})");
    EXPECT_NE(check(0).find("results/a is missing"), std::string::npos);
    write(project / "project.json.autosave", Json{{"base_hash", ""}, {"project", json}}.dump());
    json["notes"] = "newer";
    write(project / "project.json.autosave", Json{{"base_hash", ""}, {"project", json}}.dump());
    fs::last_write_time(project / "project.json", fs::file_time_type::clock::now() - std::chrono::hours(1));
    EXPECT_NE(check(0).find("holds changes that were never saved"), std::string::npos);
}

TEST_F(ProjectCommand, RefusesDamagedFilesAndWrongUsage) {
    expect_refused("--check --upgrade", 2, "--");
    expect_refused("--nonsense", 2, "--nonsense");
    write(project / "project.json", "{");
    for (const char* flags : {"", "--check", "--upgrade", "--verify", "--prune"})
        expect_refused(flags, 3, "project.json");
    fs::remove(project / "project.json");
    expect_refused("--check", 3, "holds no project.json");
}

TEST_F(ProjectCommand, UpgradesAnOldSchemaAndKeepsTheOldFile) {
    const auto old = read(TEST_DATA "/projects/schema-1.json");
    write(project / "project.json", old);
    const auto upgraded = Json::parse(command("--upgrade --json").out);
    EXPECT_NE(upgraded["changes"].dump().find("from schema 1 to "), std::string::npos);
    EXPECT_EQ(Json::parse(read(project / "project.json"))["schema"], projects::schema_version);
    EXPECT_EQ(read(project / "project.json.previous"), old);
    EXPECT_EQ(command("--upgrade").out, "nothing to upgrade\n");

    const auto lock = projects::Lock::acquire(project);
    expect_refused("--upgrade", 1, "cannot be upgraded");
    EXPECT_EQ(command("--check").status, 3);  // looking needs no lock; its scenes are missing
}

TEST_F(ProjectCommand, VerifiesWithOneJsonObject) {
    EXPECT_EQ(command("--verify").out, "no experiment has a kept result\n");
    EXPECT_EQ(Json::parse(command("--verify --json").out)["results"], Json::array());
    keep();
    auto outcome = command("--verify --json");
    EXPECT_EQ(outcome.status, 0);
    auto row = Json::parse(outcome.out)["results"][0];
    EXPECT_EQ(row["experiment"], id());
    EXPECT_EQ(row["identical"], true);
    EXPECT_EQ(row["rmse"], 0.0);
    EXPECT_EQ(row["changed"], Json::array());

    json["experiments"][0]["seed"] = 999;
    json["experiments"][0]["size"] = {12, 12};
    store();
    EXPECT_NE(check(0).find("stale"), std::string::npos);
    row = Json::parse(command("--verify --json").out)["results"][0];
    EXPECT_EQ(row["identical"], false);
    EXPECT_NE(row["changed"].dump().find("seed"), std::string::npos);
    EXPECT_NE(row["changed"].dump().find("size"), std::string::npos);
    EXPECT_NE(command("--verify").out.find("of another size"), std::string::npos);
}

TEST_F(ProjectCommand, KeptResultsAreOfTheFilesAsTheyAre) {
    const auto write_triangle = [&](float side) {
        test::GltfBuilder builder;
        const int positions = builder.floats({0, 0, 0, side, 0, 0, 0, side, 0}, "VEC3");
        builder.draw({{"POSITION", positions}});
        write(project / "triangle.gltf", builder.embedded_text());
    };
    write_triangle(1);
    json["scenes"][0]["parts"][0] = {{"source", "triangle.gltf"}, {"content_hash", "of another file"}};
    json["experiments"][0].erase("camera");  // one of the scene that it had
    store();
    keep();
    const auto result = [&] { return Json::parse(command("--json").out)["experiments"][0]["result"]; };
    EXPECT_EQ(json["scenes"][0]["parts"][0]["content_hash"], "of another file") << "nobody accepted it";
    EXPECT_EQ(result(), "current");
    EXPECT_EQ(Json::parse(command("--verify --json").out)["results"][0]["changed"], Json::array());

    write_triangle(2);
    EXPECT_EQ(result(), "stale");
    EXPECT_NE(Json::parse(command("--verify --json").out)["results"][0]["changed"].dump().find("scene"),
              std::string::npos);
    write_triangle(1);
    EXPECT_EQ(result(), "current");

    json["scenes"][0]["parts"][0].erase("content_hash");
    store();
    keep();
    EXPECT_FALSE(json["scenes"][0]["parts"][0].contains("content_hash")) << "the document is not written";
    EXPECT_EQ(result(), "current");
    write_triangle(2);
    EXPECT_EQ(result(), "stale");
    for (const auto& entry : fs::recursive_directory_iterator(project / "results"))
        EXPECT_NE(entry.path().extension(), ".tmp");
}

TEST_F(ProjectCommand, PathsWithLineBreaksGiveOneLine) {
    json["scenes"][0]["parts"][0]["source"] = "gone\nand\nlost.glb";
    store();
    const auto outcome = run("render " + project.string() + " --quiet --out " + (root_ / "out").string());
    EXPECT_EQ(outcome.status, 3);
    EXPECT_NE(outcome.err.find("gone?and?lost.glb"), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    const auto missing = run("project \"$(printf 'no\\nfolder')\" --check");
    EXPECT_EQ(missing.status, 3);
    EXPECT_EQ(std::count(missing.err.begin(), missing.err.end(), '\n'), 1) << missing.err;
}

TEST_F(ProjectCommand, VerifyReportsWhatIsMissingAndGoesOn) {
    keep();
    const auto index = projects::ResultIndex::load(project);
    const auto picture = project / "results" / index.entries().at(0).files.at(0).path;
    fs::rename(picture, picture.string() + ".away");
    auto outcome = command("--verify --json");
    EXPECT_EQ(outcome.status, 3);
    EXPECT_NE(Json::parse(outcome.out)["results"][0]["error"].dump().find(picture.filename().string()),
              std::string::npos);
    fs::remove_all(project / "results");
    outcome = command("--verify");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.out.find("no experiment has a kept result"), std::string::npos);
}

TEST_F(ProjectCommand, HasAThumbnailOfThePictureThatItKeptLast) {
    const auto png = (root_ / "small.png").string(), packed = (root_ / "p.interreflect.tar").string();
    const auto none = run("thumbnail " + project.string() + " " + png);
    EXPECT_EQ(none.status, 1);
    EXPECT_NE(none.err.find("keeps no picture"), std::string::npos) << none.err;
    keep();
    EXPECT_EQ(command("--pack " + packed).status, 0);
    EXPECT_EQ(run("thumbnail " + packed + " " + png + " --size 8").status, 0);
    const auto of_packed = read(png);
    EXPECT_EQ(of_packed.substr(1, 3), "PNG");
    EXPECT_EQ(of_packed[19], 8) << "pixels across";
    EXPECT_EQ(run("thumbnail " + project.string() + " " + png + " --size 8").status, 0);
    EXPECT_EQ(read(png), of_packed);
    EXPECT_EQ(run("thumbnail " + packed + " " + packed).status, 2) << "it would be overwritten";
}

TEST_F(ProjectCommand, AThumbnailUnpacksNoEndlessList) {
    const auto packed = (root_ / "large.tar").string();
    fs::create_directories(root_ / "large.interreflect/results");
    std::ofstream(root_ / "large.interreflect/results/index.json") << std::string(17 << 20, ' ');
    ASSERT_EQ(std::system(("tar -cf " + packed + " -C " + root_.string() + " large.interreflect").c_str()),
              0);
    const auto outcome = run("thumbnail " + packed + " " + (root_ / "small.png").string());
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("more than 16 MiB"), std::string::npos) << outcome.err;
}

TEST_F(ProjectCommand, WritesNothingOverItsOwnFiles) {
    const auto document = project / "project.json";
    const auto before = read(document);
    fs::create_symlink(document, root_ / "link");
    for (const auto& target : {document, root_ / "link", project / "results/index.json"})
        expect_refused("--pack " + target.string(), 2, "is a file of the project");
    const auto expect_unwritten = [&](const std::string& arguments, const std::string& why) {
        const auto outcome = run(arguments);
        EXPECT_EQ(outcome.status, 2) << arguments << outcome.err;
        EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    };
    const auto render = "render " + project.string() + " --out " + (root_ / "o").string() + " --json ";
    expect_unwritten(render + document.string(), "is a file of the project");
    expect_unwritten(render + (root_ / "o" / (id() + ".json")).string(), "is the file of --out");
    expect_unwritten("render " + project.string() + " --out " + (project / "results").string(),
                     "is a file of the project");
    EXPECT_EQ(read(document), before);
    EXPECT_FALSE(fs::exists(root_ / "o"));
}

}  // namespace
}  // namespace ir
