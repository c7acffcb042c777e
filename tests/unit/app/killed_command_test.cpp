// Commands that are killed at each system call by which they change files: what was there stays or is
// replaced whole, and the same command does it then. And those on a disk that does not answer.
#include <csignal>
#include <functional>

#include "projects/document.h"
#include "projects/results.h"
#include "renderers/image/exr.h"
#include "tests/unit/app/outcome.h"
#include "tests/unit/scene/gltf_builder.h"

namespace ir {
namespace {

class KilledCommand : public CommandTest {
  protected:
    void SetUp() override {
#ifdef INTERREFLECT_SANITIZED
        GTEST_SKIP() << "a sanitizer must be loaded first";
#endif
        CommandTest::SetUp();
        test::GltfBuilder builder;
        builder.draw({{"POSITION", builder.triangle_positions()}});
        fs::create_directories(file("scenes"));
        std::ofstream(file("scenes/a.gltf")) << builder.embedded_text();
    }

    /// A project of the triangle at the place that commands change, and nothing else.
    void begin() const {
        fs::remove_all(place());
        fs::create_directories(place() + "/out");
        fs::create_directories(project());
        Json json{{"schema", projects::schema_version}, {"name", "Small"}};
        json["scenes"] = {{{"id", "triangle"}, {"parts", {{{"source", file("scenes/a.gltf")}}}}}};
        json["experiments"] = {{{"id", "a"},
                                {"scene", "triangle"},
                                {"method", "reference"},
                                {"values", {{"samples", 2}}},
                                {"size", {8, 8}}}};
        json["sweeps"] = {
            {{"id", "s"}, {"experiment", "a"}, {"axes", {{{"key", "samples"}, {"values", {1, 2}}}}}}};
        std::ofstream(project() + "/project.json") << json.dump(2);
    }
    std::string place() const {
        return file("place");
    }
    std::string project() const {
        return file("place/p.interreflect");
    }

    /// In a shell's words: the program's own end, or the signal that killed it.
    int run_until(int step, const std::string& arguments) const {
        const auto command =
            "exec env LD_PRELOAD=" KILL_AT_LIBRARY " KILL_BELOW=" + place() +
            (step > 0 ? " KILL_AT=" + std::to_string(step) : " KILL_COUNT=" + file("count")) + " " +
            CLI_PROGRAM + " " + arguments + " >" + file("stdout") + " 2>" + file("stderr");
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

    /// On a network that does each thing and loses the answer.
    int run_on_network(const std::string& arguments) const {
        const auto command = "exec env LD_PRELOAD=" LOSE_ANSWERS_LIBRARY " LOSE_BELOW=" + place() +
                             " " CLI_PROGRAM " " + arguments + " >" + file("stdout") + " 2>" + file("stderr");
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

    /// Kills the command at every step, or at `most` of them; `check(done)` looks at what is there.
    void kill_at_each_step(const std::string& arguments, int most, const std::function<void()>& prepare,
                           const std::function<void(bool done)>& check) const {
        begin();
        prepare();
        ASSERT_EQ(run_until(0, arguments), 0) << read(file("stderr"));
        check(true);
        const int steps = std::stoi(read(file("count")));
        ASSERT_GE(steps, 4);
        if (std::getenv("INTERREFLECT_ALL_KILLS")) most = steps;
        int killed = 0, last = 0;
        for (int i = 1; i <= std::min(most, steps); ++i) {
            const int step = 1 + (i - 1) * steps / std::min(most, steps);
            begin();
            prepare();
            const int status = run_until(step, arguments);
            EXPECT_TRUE(status == 128 + SIGKILL || status == 0) << status << read(file("stderr"));
            killed += status != 0;
            check(false);
            EXPECT_EQ(run(arguments).status, 0) << read(file("stderr"));
            check(true);
            if (HasFailure()) FAIL() << arguments << " killed at step " << step << " of " << steps;
            last = step;
        }
        EXPECT_GT(killed, std::min(most, steps) / 2) << "the last of them at " << last;
        RecordProperty("steps", steps);
    }

    const std::string old = "what was there before";
};

TEST_F(KilledCommand, PackingReplacesTheFileWholeOrNotAtAll) {
    const auto packed = place() + "/out/p.tar";
    std::string whole;
    kill_at_each_step(
        "project " + project() + " --pack " + packed, 100, [&] { std::ofstream(packed) << old; },
        [&](bool done) {
            const auto now = read(packed);
            if (whole.empty()) whole = now;
            EXPECT_TRUE(now == whole || (!done && now == old)) << now.size() << " bytes";
        });
}

TEST_F(KilledCommand, UnpackingMakesAWholeProjectOrNone) {
    begin();
    const auto packed = file("p.tar"), there = place() + "/out";
    ASSERT_EQ(run("project " + project() + " --pack " + packed).status, 0);
    const auto command = "project " + packed + " --unpack " + there;
    const auto is_whole = [&] {
        return fs::exists(there + "/p.interreflect/project.json") &&
               read(there + "/p.interreflect/files/1/a.gltf") == read(file("scenes/a.gltf"));
    };
    begin();
    ASSERT_EQ(run_until(0, command), 0);
    EXPECT_TRUE(is_whole());
    const int steps = std::stoi(read(file("count")));
    ASSERT_GE(steps, 6);
    for (int step = 1; step <= steps; ++step) {
        begin();
        run_until(step, command);
        const bool is_there = fs::exists(there + "/p.interreflect");
        EXPECT_TRUE(!is_there || is_whole()) << step;
        EXPECT_EQ(run(command).status, is_there ? 1 : 0) << step << read(file("stderr"));
        EXPECT_TRUE(is_whole()) << step;
    }
}

TEST_F(KilledCommand, KeepingLosesNoResult) {
    kill_at_each_step(
        "render " + project() + " --keep --quiet --out " + place() + "/out", 5, [] {},
        [&](bool done) {
            const auto index = projects::ResultIndex::load(project());
            EXPECT_TRUE(projects::check_results(index, project()).empty());
            EXPECT_TRUE(!done || index.entries().size() == 1);
            EXPECT_EQ(run("project " + project() + " --check").status, 0);
        });
}

TEST_F(KilledCommand, DeletingLeavesNoListedResultWithoutItsFile) {
    begin();
    ASSERT_EQ(run("render " + project() + " --keep --quiet --out " + place() + "/out").status, 0);
    const auto kept = file("kept");
    fs::copy(project(), kept, fs::copy_options::recursive);
    kill_at_each_step(
        "project " + project() + " --prune", 100,
        [&] {
            fs::remove_all(project());
            fs::copy(kept, project(), fs::copy_options::recursive);
            auto json = Json::parse(read(project() + "/project.json"));
            json["experiments"] = Json::array();
            json["sweeps"] = Json::array();
            std::ofstream(project() + "/project.json") << json.dump(2);
            std::ofstream(project() + "/results/stray.exr") << "of no result";
        },
        [&](bool) {
            const auto index = projects::ResultIndex::load(project());
            EXPECT_TRUE(projects::check_results(index, project()).empty());
        });
}

TEST_F(KilledCommand, SweepsGoOn) {
    const auto out = place() + "/out";
    const auto values = [&] {
        auto list = Json::parse(read(out + "/sweep.json"));
        std::string text;
        for (const auto& point : list["points"])
            text += point["coordinates"].dump() + point.value("image", "none") + "\n";
        return text;
    };
    std::string whole;
    kill_at_each_step(
        "sweep " + project() + " s --resume --quiet --out " + out, 5, [] {},
        [&](bool done) {
            for (const char* name : {"/a-0001.exr", "/a-0002.exr"})
                EXPECT_TRUE(fs::exists(out + name) ? !read_image(out + name).empty() : !done);
            if (!done) return;
            if (whole.empty()) whole = values();
            EXPECT_EQ(values(), whole);
        });
}

TEST_F(KilledCommand, WhatANetworkDidCountsAlsoWhereItsAnswerIsLost) {
    begin();
    const auto packed = place() + "/out/p.tar", there = place() + "/out/there", out = place() + "/out";
    fs::create_directories(there);
    for (const auto& arguments :
         {"project " + project() + " --pack " + packed, "project " + packed + " --unpack " + there,
          "render " + project() + " --keep --quiet --out " + out, "project " + project() + " --check",
          "sweep " + project() + " s --quiet --out " + out + "/s",
          "report " + project() + " --quiet --out " + out + "/a.html"})
        EXPECT_EQ(run_on_network(arguments), 0) << arguments << "\n" << read(file("stderr"));
    EXPECT_TRUE(fs::exists(there + "/p.interreflect/project.json"));
    EXPECT_EQ(projects::ResultIndex::load(project()).entries().size(), 1u);
    std::ofstream(project() + "/results/stray.exr") << "of no result";
    EXPECT_EQ(run_on_network("project " + project() + " --prune"), 0) << read(file("stderr"));
    EXPECT_FALSE(fs::exists(project() + "/results/stray.exr"));
    for (const auto& entry : fs::recursive_directory_iterator(place()))
        EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
}

TEST_F(KilledCommand, ReportsAndPicturesAreWholeOrAsBefore) {
    const auto scene = "--scene " + file("scenes/a.gltf") + " --method view-normals --size 8x8 --quiet ";
    const auto picture = place() + "/out/a.exr", numbers = place() + "/out/a.json";
    kill_at_each_step(
        "render " + scene + "--out " + picture + " --json " + numbers, 5,
        [&] {
            std::ofstream(picture) << old;
            std::ofstream(numbers) << old;
        },
        [&](bool done) {
            EXPECT_TRUE((!done && read(picture) == old) || !read_image(picture).empty());
            EXPECT_TRUE((!done && read(numbers) == old) || !Json::parse(read(numbers)).empty());
        });
    for (const char* name : {"/1.exr", "/2.exr"})
        ASSERT_EQ(run("render " + scene + "--out " + folder_.string() + name).status, 0);
    const auto page = place() + "/out/a.html";
    kill_at_each_step(
        "report " + file("1.exr") + " " + file("2.exr") + " --quiet --out " + page, 5,
        [&] { std::ofstream(page) << old; },
        [&](bool done) {
            const auto now = read(page);
            EXPECT_TRUE((!done && now == old) || now.find("</html>") != std::string::npos);
        });
}

}  // namespace
}  // namespace ir
