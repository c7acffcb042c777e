// `film` on the real program.
#include <cstdlib>
#include <fstream>

#include "renderers/image/exr.h"
#include "renderers/image/metrics.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

class FilmCommand : public CommandTest {
  protected:
    void TearDown() override {
        ::setenv("PATH", path_.c_str(), 1);
        CommandTest::TearDown();
    }

    /// A project whose camera moves for 0.1 s, and an experiment of each method.
    void write_project(const std::string& experiments) const {
        fs::create_directories(file("project"));
        std::ofstream(file("project/project.json")) << R"({"schema": 6,
            "scenes": [{"id": "box", "parts": [{"source": "builtin:cornell@1"}]}],
            "cameras": [{"id": "eye", "name": "Eye", "eye": [0, 0, 2], "target": [0, 0, 0]}],
            "motion": [{"id": "walk", "name": "Walk", "moves": "camera", "camera": "eye", "keys": [
                {"time": 0, "eye": [0, 0, 2], "target": [0, 0, 0]},
                {"time": 0.1, "eye": [0.5, 0, 2], "target": [0, 0, 0]}]}],
            "experiments": [)" << experiments << "]}";
    }
    Image picture(const std::string& name) const { return read_image(file(name)); }
    bool are_equal(const std::string& a, const std::string& b) const {
        return picture(a).pixels == picture(b).pixels;
    }

    const std::string path_ = std::getenv("PATH");
    const std::string turn_ =
        "film --quiet --scene builtin:cornell --method view-normals --size 24x16 --turntable 0.1 --out ";
};

TEST_F(FilmCommand, TurnsTheCameraOnceAboutItsTarget) {
    ASSERT_EQ(run(turn_ + file("out")).status, 0);
    EXPECT_TRUE(fs::exists(file("out/0003.png")));
    EXPECT_FALSE(fs::exists(file("out/0004.png"))) << "the fourth would be the first again";
    EXPECT_FALSE(are_equal("out/0001.png", "out/0002.png"));
    ASSERT_EQ(run("render --quiet --scene builtin:cornell --method view-normals --size 24x16 --out " +
                  file("still.png"))
                  .status,
              0);
    EXPECT_TRUE(are_equal("out/0001.png", "still.png"));
    ASSERT_EQ(run(turn_ + file("twice") + " --until 0.1").status, 0);
    EXPECT_TRUE(are_equal("twice/0004.png", "twice/0001.png")) << "it goes on turning";
    const auto shorter = run(turn_ + file("twice"));
    EXPECT_NE(shorter.err.find("further pictures of another film, from 0004.png on"), std::string::npos)
        << shorter.err;
}

TEST_F(FilmCommand, ShowsEachPictureAtItsTime) {
    write_project(
        R"({"id": "normals", "scene": "box", "camera": "eye", "method": "view-normals", "size": [24, 16]},
                     {"id": "truth", "scene": "box", "camera": "eye", "method": "reference", "size": [12, 8],
                      "values": {"samples": 2}})");
    const auto film = "film --quiet " + file("project") + " --experiment ";
    const auto normals = run(film + "normals --out " + file("out"));
    ASSERT_EQ(normals.status, 0) << normals.err;
    EXPECT_TRUE(fs::exists(file("out/0004.png")));
    EXPECT_FALSE(fs::exists(file("out/0005.png")));
    for (const char* method : {"normals", "truth"}) {
        const auto folder = file(method);
        ASSERT_EQ(run(film + method + std::string(" --until 0.0667 --out ") + folder).status, 0);
        ASSERT_EQ(run("render --quiet " + file("project") + " --experiment " + method +
                      " --time 0.06666666666666667 --out " + file("still"))
                      .status,
                  0);
        EXPECT_TRUE(are_equal(std::string(method) + "/0003.png", std::string("still/") + method + ".png"))
            << method;
    }
    EXPECT_NE(run("film " + file("project") + " --out " + file("out")).err.find("give --experiment"),
              std::string::npos);
}

TEST_F(FilmCommand, MakesAVideoByFfmpeg) {
    const auto ffmpeg = file("ffmpeg");
    std::ofstream(ffmpeg) << "#!/bin/sh\nfor word; do echo \"$word\"; done >" + file("words") +
                                 "\nfor word; do last=${word#file:}; done\ncd \"$(dirname \"$(grep %04d " +
                                 file("words") + ")\")\" && ls *.png >\"$last\"\n";
    fs::permissions(ffmpeg, fs::perms::owner_all);
    ::setenv("PATH", (folder_.string() + ":" + path_).c_str(), 1);
    const auto made = run(turn_ + file("turn.mp4"));
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_EQ(read(file("turn.mp4")), "0001.png\n0002.png\n0003.png\n");
    EXPECT_NE(read(file("words")).find("-framerate\n30\n"), std::string::npos);
    EXPECT_FALSE(fs::exists(file(".turn.partial.mp4")));

    std::ofstream(ffmpeg) << "#!/bin/sh\nfor word; do last=${word#file:}; done\necho half >\"$last\"\n"
                             "echo 'no such encoder' >&2\nexit 1\n";
    const auto failed = run(turn_ + file("broken.mp4"));
    EXPECT_EQ(failed.status, 1);
    EXPECT_NE(failed.err.find("ffmpeg failed: no such encoder"), std::string::npos) << failed.err;
    EXPECT_FALSE(fs::exists(file("broken.mp4")));
    EXPECT_FALSE(fs::exists(file(".broken.partial.mp4")));
}

TEST_F(FilmCommand, SaysWhatIsWrongBeforeItRenders) {
    const std::string still = "film --scene builtin:cornell --method view-normals --size 24x16 --out ";
    const auto nothing = run(still + file("out"));
    EXPECT_EQ(nothing.status, 2);
    EXPECT_NE(nothing.err.find("nothing moves"), std::string::npos) << nothing.err;
    EXPECT_EQ(run(still + file("out") + " --time 2 --until 1").status, 2);
    EXPECT_EQ(run(turn_ + file("out.avi")).status, 2);
    write_project({});
    EXPECT_EQ(run(turn_ + file("project")).status, 2);
    EXPECT_EQ(run(turn_ + file("none/out.mp4")).status, 2);
    EXPECT_EQ(run("film --scene builtin:cornell --out " + file("out")).status, 2);
    ::setenv("PATH", folder_.c_str(), 1);
    const auto without = run(turn_ + file("out.mp4"));
    EXPECT_EQ(without.status, 2);
    EXPECT_NE(without.err.find("ffmpeg, which is not in PATH"), std::string::npos) << without.err;
}

}  // namespace
}  // namespace ir
